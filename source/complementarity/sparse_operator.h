// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sparse_operator_h
#define taut_sparse_operator_h

#include "complementarity/dense_operator.h"
#include "complementarity/patterned_cholesky.h"

#include <memory>
#include <vector>

namespace taut
{
  /**
   * F as a sparse matrix with a sparse factor. Use it for many constraints that act on each other
   * only near by: along a line F is banded. The last rows are a border that may change in every
   * step: a changed row costs one forward substitution with the kept factor of the other rows.
   * Rows that open or close have only the rows factored again that depend on them. Nothing is
   * allocated while the pattern stays, except a second factor at the first call with a shift.
   */
  class SparseOperator : public ComplementarityOperator
  {
  public:
    /// Zero matrix of @p n rows, of which the last @p n_border are the border.
    void reinit(std::size_t n, std::size_t n_border);

    /// Sets the entries of the rows before the border; earlier entries are replaced, entries of one
    /// position add. The pattern of all entries since reinit() is kept while these fill half of it.
    void set_interior(const SymmetricEntries &entries);

    /// Sets row i of the border, n entries: F_ij = F_ji = entries[j]. Where two rows of the border
    /// cross, the later call counts. Equal entries keep what is computed from the row.
    void set_border(std::size_t i, const std::vector<double> &entries);

    /// Sets F_ii = value.
    void set_diagonal(std::size_t i, double value);

    std::size_t size() const override { return n; }
    double diagonal(std::size_t i) const override
    {
      return i < n_interior ? interior.diagonal[i] : border[i - n_interior].entries[i];
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
                            const SharedRows *shared, std::vector<double> &result) override;

    /// Stored entries of the lower triangle before the border.
    std::size_t n_entries() const { return interior.column.size() + n_interior; }

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
      bool is_set_up = false;
      double shift = 0.;
      PatternedCholesky interior;
      std::size_t version = 0;                        ///< of the interior factor of the responses
      std::vector<std::vector<double>> response;      ///< L^-1 F_ab of each row b, by place
      std::vector<std::vector<unsigned int>> reached; ///< places where a response is not 0
      std::vector<char> is_current;                   ///< of each response, and its row of `schur`
      DenseOperator schur;

      void reinit(const std::shared_ptr<const EliminationPattern> &pattern, std::size_t n_border);
      void forget_responses();

      /// The part of row b of the border in the elimination of numbers by place.
      double share(std::size_t b, const std::vector<double> &x) const;
    };

    void set_pattern(const SymmetricEntries &entries);
    template <typename Weight>
    void multiply(const std::vector<double> &x, std::vector<double> &y, const Weight &weight) const;
    bool prepare(Factor &used, const std::vector<std::size_t> &set, double shift);
    void respond(Factor &used, std::size_t b) const;
    double condensed(Factor &used, std::size_t i);
    Factor &of_shift(const double shift) { return shift == 0. ? factor : shifted_factor; }

    std::size_t n = 0, n_interior = 0;
    SparseTriangle interior;
    std::vector<BorderRow> border;
    std::shared_ptr<const EliminationPattern> pattern; ///< of the interior, after the first solve()

    /// A shifted and an unshifted factor, so that a redundant set does not refactor both in every
    /// step.
    Factor factor, shifted_factor;

    /// The current set: its rows in the interior, and in the border.
    std::vector<char> active;
    std::vector<std::size_t> active_border;
    std::vector<double> work, rhs_border, x_border; ///< by place; by row of the border
    std::vector<unsigned int> places;               ///< of entries of `work`
  };
} // namespace taut

#endif
