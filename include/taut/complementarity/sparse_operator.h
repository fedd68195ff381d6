// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sparse_operator_h
#define taut_sparse_operator_h

#include <taut/base/sparse_cholesky.h>
#include <taut/complementarity/operator.h>

namespace taut
{
  /**
   * F as a sparse matrix with a sparse factor. Use it for many constraints that act on each other
   * only near by: along a line F is banded. The last rows are a dense border that may change in
   * every step, at the cost of one solve with the kept factor of the other rows. A new active set
   * needs a new factorisation, in the order of the first one.
   */
  class SparseOperator : public ComplementarityOperator
  {
  public:
    /// Zero matrix of @p n rows, of which the last @p n_border are the border.
    void reinit(std::size_t n, std::size_t n_border);

    /// Sets the entries of the rows before the border; earlier entries are replaced.
    void set_interior(const SymmetricEntries &entries);

    /// Sets row i of the border, n entries: F_ij = F_ji = entries[j]. Where two rows of the border
    /// cross, the later call counts.
    void set_border(std::size_t i, const std::vector<double> &entries);

    /// Sets F_ii = value; F_ii must have been given before.
    void set_diagonal(std::size_t i, double value);

    std::size_t size() const override { return n; }
    double diagonal(std::size_t i) const override { return diagonal_entries[i]; }
    void apply(const std::vector<double> &x, std::vector<double> &y) const override;

    /// Exactly sum_j |F_ij| |x_j|.
    void apply_absolute(const std::vector<double> &x, std::vector<double> &y) const override;

    /// Rows are dependent if a pivot is below 1e-12 of its diagonal entry.
    bool solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs, double shift,
               std::vector<double> &x) override;

    /// Stored entries of the lower triangle before the border.
    std::size_t n_entries() const { return interior.size(); }

  private:
    /// The factor of the interior rows of an active set.
    struct Factor
    {
      SparseCholesky interior;
      std::vector<char> active; ///< rows of the interior; empty: nothing is factored
      double shift = 0.;
      bool is_definite = false;
    };

    template <typename Weight>
    void multiply(const std::vector<double> &x, std::vector<double> &y, const Weight &weight) const;
    bool update(Factor &factor, const std::vector<char> &active, double shift) const;
    bool solve_border(const Factor &factor, const std::vector<std::size_t> &rows,
                      std::vector<double> &x) const;

    std::size_t n = 0, n_interior = 0;
    SymmetricEntries interior;               ///< each position once
    std::vector<std::vector<double>> border; ///< rows of n entries
    std::vector<double> diagonal_entries;
    std::vector<std::size_t> diagonal_position; ///< of each row of the interior in `interior`

    /// A shifted and an unshifted factor, so that a redundant set does not refactor both in every
    /// step.
    Factor factor, shifted_factor;
  };
} // namespace taut

#endif
