// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_dot_h
#define taut_dot_h

#include <cstddef>
#include <vector>

namespace taut
{
  /// Scalar product of two vectors of equal length, summed from the first entry on.
  inline double dot(const std::vector<double> &x, const std::vector<double> &y)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += x[i] * y[i];
    return sum;
  }

  /// The same in independent partial sums, for long vectors.
  double dot_in_lanes(const std::vector<double> &x, const std::vector<double> &y);
} // namespace taut

#endif
