// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/dot.h"
#include "base/instruction_set.h"

#include <array>
#include <numeric>

namespace taut
{
  double dot_in_lanes(const std::vector<double> &x, const std::vector<double> &y)
  {
    constexpr std::size_t lanes = 16;
    std::array<double, lanes> sums = {};
    vectorised(
        [&sums, a = x.data(), b = y.data(), n = x.size()]
        {
          std::array<double, lanes> s = {};
          for (std::size_t i = 0; i + lanes <= n; i += lanes)
#pragma omp simd
            for (std::size_t l = 0; l < lanes; ++l)
              s[l] += a[i + l] * b[i + l];
          for (std::size_t i = n - n % lanes; i < n; ++i)
            s[i % lanes] += a[i] * b[i];
          sums = s;
        });
    return std::accumulate(sums.begin(), sums.end(), 0.);
  }
} // namespace taut
