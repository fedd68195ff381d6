// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_coupled_rows_h
#define taut_coupled_rows_h

#include <cstddef>
#include <vector>

namespace taut
{
  /// Upper bound of the largest eigenvalue of the rows @p group of a nonnegative matrix (L.
  /// Collatz, 1942): the largest (G x)_i / x_i for a positive x.
  double largest_eigenvalue(const std::vector<std::vector<double>> &G,
                            const std::vector<std::size_t> &group);

  /// Groups of rows that entries of a symmetric matrix couple.
  std::vector<std::vector<std::size_t>> coupled_rows(const std::vector<std::vector<double>> &G);
} // namespace taut

#endif
