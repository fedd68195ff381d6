// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/interface/turning_direction.h>

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

  Coordinates TurningDirection::at(const Coordinates &difference) const
  {
    const Coordinates &d = vanishes(difference) ? start : difference;
    const double size = norm(d);
    return {d.x / size, d.y / size, d.z / size};
  }

  std::vector<Term> TurningDirection::along(const Coordinates &direction) const
  {
    std::vector<Term> terms;
    for (unsigned int c = 0; c < 3; ++c)
      for (const auto &[k, form] : motion[c])
      {
        const std::size_t body = k;
        auto term = std::find_if(terms.begin(), terms.end(),
                                 [&](const Term &t) { return t.substructure == body; });
        if (term == terms.end())
        {
          terms.push_back({k, {}});
          term = terms.end() - 1;
        }
        for (std::size_t j = 0; j < form.index.size(); ++j)
          term->form.add(form.index[j], direction[c] * form.value[j]);
      }
    return terms;
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

  std::string text_of(const Coordinates &place)
  {
    std::ostringstream out;
    out << '(' << place.x << ", " << place.y << ", " << place.z << ") m";
    return out.str();
  }
} // namespace taut
