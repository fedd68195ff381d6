// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/motion_along.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace taut
{
  TurningDirection::TurningDirection(std::vector<LinkEnd> all, const double push)
      : places(std::move(all)), sign(push)
  {
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
      start.push_back(places[k + 1].position - places[k].position);
    length = distance(start.data());
  }

  double TurningDirection::distance(const Coordinates *const differences) const
  {
    double sum = 0.;
    for (std::size_t k = 0; k < size(); ++k)
      sum += norm(differences[k]);
    return sum;
  }

  std::string TurningDirection::fault() const
  {
    const auto is_finite = [](const Coordinates &place)
    { return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z); };
    if (!std::isfinite(length))
      return "its length is " + to_text(length) + " m; take a finite one";
    if (!std::all_of(places.begin(), places.end(),
                     [&](const LinkEnd &place) { return is_finite(place.position); }))
      return "an end or ring is at no finite place; give its position at U = 0";
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
    std::vector<const std::vector<Term> *> result;
    for (const LinkEnd &place : places)
      for (const std::vector<Term> &motion : place.motion)
        result.push_back(&motion);
    return result;
  }

  Coordinates TurningDirection::at(const std::size_t segment, const Coordinates &difference) const
  {
    const Coordinates &d = vanishes(difference) ? start[segment] : difference;
    const double size = norm(d);
    return {d.x / size, d.y / size, d.z / size};
  }

  TurningDirection::Linear TurningDirection::linearised(const Coordinates *const motions) const
  {
    Linear result;
    std::vector<Coordinates> differences;
    double moved = 0.;
    for (std::size_t k = 0; k < size(); ++k)
    {
      differences.push_back(add_scaled(start[k], 1., motions[k]));
      result.directions.push_back(at(k, differences[k]));
      result.distances.push_back(norm(differences[k]));
      moved += dot(result.directions[k], motions[k]);
    }
    set_motion_along(*this, result.directions.data(), result.terms);
    result.gap = gap(differences.data()) - sign * moved;
    return result;
  }

  namespace
  {
    /// Appends the motion of a place along @p direction to the first @p n terms, with the memory of
    /// terms behind them. A form on one body is that of one place, so that its columns have single
    /// elements.
    void append_motion(const LinkEnd &place, const Coordinates &direction, std::vector<Term> &terms,
                       std::size_t &n)
    {
      const std::size_t begin = n;
      for (unsigned int c = 0; c < 3; ++c)
        for (const Term &own : place.motion[c])
        {
          std::size_t to = begin;
          while (to < n && terms[to].substructure != own.substructure)
            ++to;
          if (to == n)
          {
            terms.resize(std::max(++n, terms.size()));
            terms[to].substructure = own.substructure;
            terms[to].body = nullptr;
            terms[to].form.index.clear();
            terms[to].form.value.clear();
          }
          for (std::size_t j = 0; j < own.form.index.size(); ++j)
            terms[to].form.add(own.form.index[j], direction[c] * own.form.value[j]);
        }
    }
  } // namespace

  std::vector<Term> TurningDirection::along(const std::size_t segment,
                                            const Coordinates &direction) const
  {
    std::vector<Term> terms;
    std::size_t n = 0;
    append_motion(places[segment + 1], direction, terms, n);
    append_motion(places[segment], add_scaled({}, -1., direction), terms, n);
    return terms;
  }

  void set_motion_along(const TurningDirection &link, const Coordinates *const directions,
                        std::vector<Term> &terms)
  {
    std::size_t n = 0;
    for (std::size_t place = link.places.size(); place-- > 0;)
    {
      Coordinates sum;
      if (place > 0)
        sum = add_scaled(sum, link.sign, directions[place - 1]);
      if (place < link.size())
        sum = add_scaled(sum, -link.sign, directions[place]);
      append_motion(link.places[place], sum, terms, n);
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
