// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_distance_to_range_h
#define taut_distance_to_range_h

#include <algorithm>
#include <cstddef>

namespace taut
{
  /// a / b; 0 if a is 0.
  inline double ratio(const double a, const double b)
  {
    return a == 0. ? 0. : a / b;
  }

  /// Two runs whose sizes differ by this factor did not see the same scene.
  constexpr double much_smaller = 2.;

  /// Distance of @p x from the range of the values @p first to @p last; 0 inside.
  template <typename Value>
  double distance_to_range(const double x, const std::size_t first, const std::size_t last,
                           const Value &value)
  {
    double least = value(first), most = least;
    for (std::size_t j = first + 1; j <= last && (x < least || x > most); ++j)
    {
      least = std::min(least, value(j));
      most = std::max(most, value(j));
    }
    return x >= least && x <= most ? 0. : std::max(x - most, least - x);
  }
} // namespace taut

#endif
