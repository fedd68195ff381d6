// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_dense_operator_h
#define taut_dense_operator_h

#include "complementarity/bordered_cholesky.h"
#include "complementarity/operator.h"

#include <algorithm>

namespace taut
{
  /**
   * F as a dense matrix. Use it for up to some hundred constraints, where a step takes
   * microseconds. solve() keeps the factor of the set, and factors again only from the first
   * changed entry or row on. So put rows that change in every step last. Nothing is allocated after
   * reinit(), except a second factor at the first call with a shift.
   */
  class DenseOperator : public ComplementarityOperator
  {
  public:
    /// Zero matrix of @p n rows.
    explicit DenseOperator(std::size_t n = 0) { reinit(n); }

    /// Zero matrix of @p n rows; factors are forgotten.
    void reinit(std::size_t n);

    /// F_ij.
    double operator()(std::size_t i, std::size_t j) const
    {
      return entries[std::max(i, j) * n + std::min(i, j)];
    }

    /// F_ij = F_ji = value. A changed value updates the kept factors at the next solve(); an equal
    /// value keeps them.
    void set(std::size_t i, std::size_t j, double value);

    std::size_t size() const override { return n; }
    double diagonal(std::size_t i) const override { return entries[i * n + i]; }
    void apply(const std::vector<double> &x, std::vector<double> &y) const override;

    /// Exactly sum_j |F_ij| |x_j|.
    void apply_absolute(const std::vector<double> &x, std::vector<double> &y) const override;

    /// Rows are dependent if a pivot is below 1e-12 of its diagonal entry.
    bool solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs, double shift,
               std::vector<double> &x) override;

    /// Takes the columns from the entries.
    void condensed_diagonal(const std::vector<std::size_t> &wanted,
                            const std::vector<std::size_t> &set, double shift,
                            const SharedRows *shared, std::vector<double> &result) override;

  private:
    std::size_t n = 0;
    std::vector<double> entries;          ///< n x n, row-major; only the lower triangle is used
    std::vector<double> column, solution; ///< in condensed_diagonal()
    std::vector<std::size_t> first; ///< column of the first entry of each row of the lower triangle

    /// A shifted and an unshifted factor, so that a redundant set does not refactor both in every
    /// step.
    BorderedCholesky factor, shifted_factor;
    bool has_shifted_factor = false;
  };
} // namespace taut

#endif
