// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_coupled_rows_h
#define taut_coupled_rows_h

#include <cstddef>
#include <vector>

namespace taut
{
  /// The largest eigenvalue of the rows @p group of a matrix without negative entries, from above
  /// (L. Collatz, 1942): the largest (G x)_i / x_i of any positive x.
  double largest_eigenvalue(const std::vector<std::vector<double>> &G,
                            const std::vector<std::size_t> &group);

  /// Rows that have to do with each other, by the entries of a symmetric matrix.
  std::vector<std::vector<std::size_t>> coupled_rows(const std::vector<std::vector<double>> &G);
} // namespace taut

#endif
