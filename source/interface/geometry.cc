// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/motion_along.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace taut
{
  TurningDirection::TurningDirection(const LinkEnd &from, const LinkEnd &to, const double push)
      : first(from), motion(to.motion), start(to.position - from.position), length(norm(start)),
        sign(push)
  {
    for (unsigned int c = 0; c < 3; ++c)
      for (Term term : first.motion[c])
      {
        for (double &value : term.form.value)
          value = -value;
        motion[c].push_back(std::move(term));
      }
  }

  std::string TurningDirection::fault() const
  {
    const auto is_finite = [](const Coordinates &place)
    { return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z); };
    if (!std::isfinite(length))
      return "its length is " + to_text(length) + " m; take a finite one";
    if (!is_finite(first.position) || !is_finite(start))
      return "an end is at no finite place; give its position at U = 0";
    return "";
  }

  double TurningDirection::reel_rate(const double t, const double step) const
  {
    // Backward differences of second order: a table ends with the run. Their error is below 1e-5 of
    // a change of the rate in a step.
    const double delta = 1e-2 * step;
    return length_at ? (4. * reeled(t - delta, t) - reeled(t - 2. * delta, t)) / (2. * delta) : 0.;
  }

  std::vector<const std::vector<Term> *> TurningDirection::forms() const
  {
    return {&motion[0], &motion[1], &motion[2]};
  }

  Coordinates TurningDirection::at(const Coordinates &difference) const
  {
    const Coordinates &d = vanishes(difference) ? start : difference;
    const double size = norm(d);
    return {d.x / size, d.y / size, d.z / size};
  }

  TurningDirection::Linear TurningDirection::linearised(const Coordinates &moved) const
  {
    const Coordinates difference = add_scaled(start, 1., moved), d = at(difference);
    return {d, norm(difference), along({sign * d.x, sign * d.y, sign * d.z}),
            gap(difference) - sign * dot(d, moved)};
  }

  std::vector<Term> TurningDirection::along(const Coordinates &direction) const
  {
    std::vector<Term> terms;
    set_motion_along(*this, direction, terms);
    return terms;
  }

  void set_motion_along(const TurningDirection &link, const Coordinates &direction,
                        std::vector<Term> &terms)
  {
    std::size_t n = 0;
    for (const bool of_first : {false, true})
    {
      // A form on one body is that of one place, so that its columns have single elements.
      const std::size_t begin = n;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::vector<Term> &motion = link.motion[c];
        const std::size_t middle = motion.size() - link.first.motion[c].size();
        for (std::size_t e = of_first ? middle : 0; e < (of_first ? motion.size() : middle); ++e)
        {
          const Term &own = motion[e];
          std::size_t place = begin;
          while (place < n && terms[place].substructure != own.substructure)
            ++place;
          if (place == n)
          {
            terms.resize(std::max(++n, terms.size()));
            terms[place].substructure = own.substructure;
            terms[place].body = nullptr;
            terms[place].form.index.clear();
            terms[place].form.value.clear();
          }
          for (std::size_t j = 0; j < own.form.index.size(); ++j)
            terms[place].form.add(own.form.index[j], direction[c] * own.form.value[j]);
        }
      }
    }
    terms.resize(n);
  }

  std::array<Coordinates, 2> across(const Coordinates &d)
  {
    const Coordinates axis =
        std::fabs(d.x) < .6 ? Coordinates{1., 0., 0.} : Coordinates{0., 1., 0.};
    Coordinates first = cross(d, axis);
    const double size = norm(first);
    first = {first.x / size, first.y / size, first.z / size};
    return {first, cross(d, first)};
  }
} // namespace taut
