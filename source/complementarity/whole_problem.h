// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_whole_problem_h
#define taut_whole_problem_h

#include "complementarity/problem.h"

#include <vector>

namespace taut
{
  /// Marks of all rows by their numbers, from those of the rows of this rank.
  std::vector<char> gathered(const SharedRows &rows, const std::vector<char> &marks);

  /// A problem with shared rows as one with all rows on all ranks, by their numbers.
  MixedComplementarityProblem whole_problem(const MixedComplementarityProblem &problem);

  /// F of shared rows for such a problem. Each function takes messages of the length of all rows.
  class WholeOperator : public ComplementarityOperator
  {
  public:
    /// The arguments are kept by reference. Called, as all functions, by all ranks together.
    WholeOperator(ComplementarityOperator &F, const SharedRows &rows);

    std::size_t size() const override { return rows.n_of_all(); }
    double diagonal(std::size_t number) const override { return diagonals[number]; }
    void apply(const std::vector<double> &x, std::vector<double> &y) const override;
    void apply_absolute(const std::vector<double> &x, std::vector<double> &y) const override;
    bool solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs, double shift,
               std::vector<double> &x) override;
    bool solve_with_null_space(const std::vector<std::size_t> &set, const std::vector<double> &rhs,
                               const std::vector<LinearForm> &null_space,
                               const std::vector<double> &load, double shift,
                               std::vector<double> &x, std::vector<double> &alpha) override;
    bool has_null_space_solver() const override { return F.has_null_space_solver(); }
    bool is_iterative() const override { return F.is_iterative(); }
    void set_tolerance(const double tolerance) override { F.set_tolerance(tolerance); }

  private:
    std::vector<std::size_t> here(const std::vector<std::size_t> &numbers) const;

    ComplementarityOperator &F;
    const SharedRows &rows;
    std::vector<double> diagonals;
    mutable std::vector<double> in, out;
  };
} // namespace taut

#endif
