// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_repeated_rows_h
#define taut_repeated_rows_h

#include "complementarity/dense_operator.h"
#include "complementarity/problem.h"

namespace taut
{
  /**
   * Bilateral rows that repeat others: combinations z of rows with F z = 0 and G z = 0, such as two
   * hinges on one axis. Their gaps follow from those of the other rows, and multipliers along z do
   * not move anything. A problem without() them has one solution; spread() then gives all rows the
   * multipliers of least norm, in N and N m. These do not depend on F, so that they are the same at
   * rest and in motion.
   */
  class RepeatedRows
  {
  public:
    /// Finds the rows by a dense factorization of the bilateral rows. True if they
    /// are others than before. @p exact: part of its terms up to which F z counts as 0.
    bool find(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
              double exact);

    bool empty() const { return repeated.empty(); }

    /// The problem in which the rows take no part; valid until the next call.
    const MixedComplementarityProblem &without(const MixedComplementarityProblem &problem);

    /// Replaces multipliers of without() by those of least norm, with the combinations of F now.
    void spread(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
                std::vector<double> &multiplier);

    /// After find() or spread(): all rows of the combinations with a part of @p row, ascending;
    /// empty if it is in none.
    std::vector<std::size_t> partners(std::size_t row) const;

    /// All rows of all combinations, ascending.
    std::vector<std::size_t> all_partners() const;

  private:
    void set_rows(const MixedComplementarityProblem &problem,
                  const ComplementarityOperator &matrix);
    void set_combinations();
    bool are_exact(const MixedComplementarityProblem &problem,
                   const ComplementarityOperator &matrix, double exact) const;
    std::vector<std::size_t> rows_of(const std::vector<char> &is_wanted) const;

    std::vector<std::size_t> repeated;             ///< rows that without() leaves out, ascending
    std::vector<std::size_t> bilateral;            ///< rows of the problem now
    DenseOperator rows;                            ///< F + G^T W G of the bilateral rows
    std::vector<std::vector<double>> null_vectors; ///< z over bilateral
    MixedComplementarityProblem reduced;
  };
} // namespace taut

#endif
