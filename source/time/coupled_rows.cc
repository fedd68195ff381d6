// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/coupled_rows.h"

#include "base/groups.h"

#include <algorithm>
#include <limits>

namespace taut
{
  namespace
  {
    /// Accuracy of the largest eigenvalue, and bound of iterations.
    constexpr double eigenvalue_tolerance = .01;
    constexpr int most_iterations = 200;
  } // namespace

  double largest_eigenvalue(const std::vector<std::vector<double>> &G,
                            const std::vector<std::size_t> &group)
  {
    std::vector<double> x(group.size(), 1.), y(group.size());
    double above = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < most_iterations; ++iteration)
    {
      double highest = 0., lowest = std::numeric_limits<double>::infinity(), largest = 0.;
      for (std::size_t a = 0; a < group.size(); ++a)
      {
        y[a] = 0.;
        for (std::size_t b = 0; b < group.size(); ++b)
          y[a] += G[group[a]][group[b]] * x[b];
        highest = std::max(highest, y[a] / x[a]);
        lowest = std::min(lowest, y[a] / x[a]);
        largest = std::max(largest, y[a]);
      }
      above = std::min(above, highest);
      if (highest <= (1. + eigenvalue_tolerance) * lowest || !(largest > 0.))
        break;
      // The mean of both vectors converges even if the matrix only swaps them.
      for (std::size_t a = 0; a < group.size(); ++a)
        x[a] = std::max(.5 * (x[a] + y[a] / largest), std::numeric_limits<double>::min());
    }
    return above;
  }

  std::vector<std::vector<std::size_t>> coupled_rows(const std::vector<std::vector<double>> &G)
  {
    Groups groups(G.size());
    for (std::size_t a = 0; a < G.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (G[a][b] > 0.)
          groups.join(a, b);
    return groups.members();
  }
} // namespace taut
