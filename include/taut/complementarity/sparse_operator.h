// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sparse_operator_h
#define taut_sparse_operator_h

#include <taut/base/sparse_cholesky.h>
#include <taut/complementarity/dense_operator.h>

#include <vector>

namespace taut
{
  /**
   * F as a sparse matrix with a sparse factor. Use it for many constraints that act on each other
   * only near by: along a line F is banded. The last rows are a border that may change in every
   * step: a changed row costs one solve with the kept factor of the other rows. These are factored
   * again when one of them opens or closes; order and pattern of the factor stay.
   */
  class SparseOperator : public ComplementarityOperator
  {
  public:
    /// Zero matrix of @p n rows, of which the last @p n_border are the border.
    void reinit(std::size_t n, std::size_t n_border);

    /// Sets the entries of the rows before the border; earlier entries are replaced, entries of one
    /// position add.
    void set_interior(const SymmetricEntries &entries);

    /// Sets row i of the border, n entries: F_ij = F_ji = entries[j]. Where two rows of the border
    /// cross, the later call counts. Equal entries keep what is computed from the row.
    void set_border(std::size_t i, const std::vector<double> &entries);

    /// Sets F_ii = value.
    void set_diagonal(std::size_t i, double value);

    std::size_t size() const override { return n; }
    double diagonal(std::size_t i) const override
    {
      return i < n_interior ? interior.value[diagonal_entry[i]] : border[i - n_interior].entries[i];
    }
    void apply(const std::vector<double> &x, std::vector<double> &y) const override;

    /// Exactly sum_j |F_ij| |x_j|.
    void apply_absolute(const std::vector<double> &x, std::vector<double> &y) const override;

    /// Rows are dependent if a pivot is below 1e-12 of its diagonal entry.
    bool solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs, double shift,
               std::vector<double> &x) override;

    /// From half solutions, which reach few rows.
    void condensed_diagonal(const std::vector<std::size_t> &wanted,
                            const std::vector<std::size_t> &set, double shift,
                            std::vector<double> &result) override;

    /// Stored entries of the lower triangle before the border.
    std::size_t n_entries() const { return interior.size(); }

  private:
    struct BorderRow
    {
      std::vector<double> entries;      ///< n
      std::vector<unsigned int> inside; ///< rows of the interior whose entry is not 0
    };

    /// The factor of an active set: of its rows a in the interior, and of the Schur complement
    /// F_bb - F_ba F_aa^-1 F_ab of its rows b in the border.
    struct Factor
    {
      SparseCholesky interior;  ///< of F_aa, with unit rows for the others
      bool is_factored = false; ///< with the values of F, and the set and the shift that follow
      std::vector<char> active; ///< rows of the interior
      double shift = 0.;

      std::vector<std::vector<double>> response; ///< F_aa^-1 F_ab of each row b, n_interior
      std::vector<char> is_current;              ///< of each response, and its row of `schur`
      DenseOperator schur;
    };

    template <typename Weight>
    void multiply(const std::vector<double> &x, std::vector<double> &y, const Weight &weight) const;
    bool prepare(Factor &used, const std::vector<std::size_t> &set, double shift);
    bool factor_interior(Factor &used);
    void respond(Factor &used, std::size_t b) const;
    double inside(std::size_t b, const std::vector<double> &x) const;
    void condense(Factor &used, const std::vector<std::size_t> &wanted,
                  std::vector<double> &result);

    std::size_t n = 0, n_interior = 0;
    SymmetricEntries interior;               ///< ordered, each row with its diagonal
    std::vector<std::size_t> diagonal_entry; ///< index in `interior` of each row
    std::vector<BorderRow> border;

    /// An unshifted and a shifted factor, so that a redundant set does not refactor both in every
    /// step.
    Factor factor, shifted_factor;

    /// The current set: its rows in the interior, and in the border.
    std::vector<char> active;
    std::vector<std::size_t> active_border;

    SymmetricEntries factored; ///< the matrix of the factor
    std::vector<double> work, rhs_border, x_border;
  };
} // namespace taut

#endif
