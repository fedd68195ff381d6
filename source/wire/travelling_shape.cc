// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wire/travelling_shape.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

namespace taut
{
  namespace
  {
    /// Bins that are looked at together: few allocations.
    constexpr long bins_at_once = 64;

    /// A pulse that is too narrow for the elements is refused where it is seen. Without bins a run
    /// of some hundred steps sees a thousandth of an element, which has thirteen places in each
    /// step.
    constexpr std::size_t samples_of_bin = 1000;
  } // namespace

  double speed_of_shape(const std::string &formula)
  {
    static const std::regex moving("\\( *s *- *([0-9.]+) *\\* *t *(?=[-+)])"), word("\\b[st]\\b");
    std::set<std::string> speeds;
    for (std::sregex_iterator at(formula.begin(), formula.end(), moving), end; at != end; ++at)
      speeds.insert(at->str(1));
    if (speeds.size() != 1 || std::regex_search(std::regex_replace(formula, moving, "( "), word))
      return 0.;
    return std::stod(*speeds.begin());
  }

  TravellingShape::TravellingShape(const Expression &formula, const double speed, const double end,
                                   const double width)
      : formula(formula), speed(speed), end(end), width(width), places(samples_of_bin)
  {
  }

  bool TravellingShape::look(const long bin) const
  {
    for (std::size_t k = 0; k < places.size(); ++k)
      places[k] = end - width * (bin + (k + .5) / places.size());
    try
    {
      formula.evaluate(places, 0., values);
    }
    catch (const UserError &)
    {
      return true; // an error of the run, if this place comes onto the wire
    }
    return std::any_of(values.begin(), values.end(), [](const double q) { return q != 0.; });
  }

  bool TravellingShape::is_zero(const double a, const double b, const double t) const
  {
    if (t < 0.)
      return false;
    // What begins between two samples begins at most one bin away from one that sees it.
    const auto bin = [&](const double s)
    { return static_cast<long>(std::floor((end - s + speed * t) / width)); };
    const long first = std::max(0L, bin(b) - 1), last = std::max(0L, bin(a) + 1);
    while (last >= static_cast<long>(is_active.size()))
      for (long k = 0; k < bins_at_once; ++k)
        is_active.push_back(look(static_cast<long>(is_active.size())));
    for (long k = first; k <= last; ++k)
      if (is_active[k])
        return false;
    return true;
  }
} // namespace taut
