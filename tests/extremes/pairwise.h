// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_pairwise_h
#define taut_extremes_pairwise_h

#include "common.h"

namespace extremes
{
  /// Rows of level indices such that every pair of levels of two dimensions occurs in one
  /// constraint at least; @p levels are the numbers of levels. Greedy, deterministic for a seed,
  /// and not much longer than the product of the two largest numbers.
  std::vector<std::vector<std::size_t>> pairwise(const std::vector<std::size_t> &levels,
                                                 unsigned int seed);
} // namespace extremes

#endif
