// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/whole_problem.h"

namespace taut
{
  std::vector<char> gathered(const SharedRows &rows, const std::vector<char> &marks)
  {
    std::vector<double> all;
    rows.gather({marks.begin(), marks.end()}, all);
    return {all.begin(), all.end()};
  }

  MixedComplementarityProblem whole_problem(const MixedComplementarityProblem &problem)
  {
    const SharedRows &rows = *problem.shared;
    MixedComplementarityProblem result;
    std::vector<char> may_open, is_free;
    for (const Cone cone : problem.cones)
    {
      may_open.push_back(cone.may_open());
      is_free.push_back(cone.is_free());
    }
    may_open = gathered(rows, may_open);
    is_free = gathered(rows, is_free);
    for (std::size_t i = 0; i < rows.n_of_all(); ++i)
      result.cones.push_back(is_free[i]    ? Cone::free()
                             : may_open[i] ? Cone::half_line()
                                           : Cone::zero());
    rows.gather(problem.free_gap, result.free_gap);
    if (problem.any(!problem.gap_scale.empty())) // a rank without rows has an empty one
      rows.gather(problem.gap_scale, result.gap_scale);
    result.null_space_load = problem.null_space_load;
    result.null_space_terms = problem.null_space_terms;
    result.null_space_resistance = problem.null_space_resistance;
    std::vector<double> own, all;
    for (const LinearForm &vector : problem.null_space)
    {
      own.assign(rows.size(), 0.);
      vector.add_to(1., own);
      rows.gather(own, all);
      result.null_space.emplace_back();
      for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i] != 0.)
          result.null_space.back().add(static_cast<unsigned int>(i), all[i]);
    }
    return result;
  }

  WholeOperator::WholeOperator(ComplementarityOperator &F, const SharedRows &rows)
      : F(F), rows(rows)
  {
    std::vector<double> own;
    for (std::size_t i = 0; i < rows.size(); ++i)
      own.push_back(F.diagonal(i));
    rows.gather(own, diagonals);
  }

  void WholeOperator::apply(const std::vector<double> &x, std::vector<double> &y) const
  {
    rows.pick(x, in);
    F.apply(in, out);
    rows.gather(out, y);
  }

  void WholeOperator::apply_absolute(const std::vector<double> &x, std::vector<double> &y) const
  {
    rows.pick(x, in);
    F.apply_absolute(in, out);
    rows.gather(out, y);
  }

  /// Indices of the rows that this rank has.
  std::vector<std::size_t> WholeOperator::here(const std::vector<std::size_t> &numbers) const
  {
    std::vector<std::size_t> result;
    for (const std::size_t number : numbers)
      if (const std::size_t i = rows.index(number); i != SharedRows::elsewhere)
        result.push_back(i);
    return result;
  }

  bool WholeOperator::solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs,
                            const double shift, std::vector<double> &x)
  {
    rows.pick(rhs, in);
    const bool is_solved = F.solve(here(set), in, shift, out);
    rows.gather(out, x);
    return is_solved;
  }

  bool WholeOperator::solve_with_null_space(const std::vector<std::size_t> &set,
                                            const std::vector<double> &rhs,
                                            const std::vector<LinearForm> &null_space,
                                            const std::vector<double> &load, const double shift,
                                            std::vector<double> &x, std::vector<double> &alpha)
  {
    std::vector<LinearForm> own(null_space.size());
    for (std::size_t k = 0; k < own.size(); ++k)
      for (std::size_t e = 0; e < null_space[k].index.size(); ++e)
        if (const std::size_t i = rows.index(null_space[k].index[e]); i != SharedRows::elsewhere)
          own[k].add(static_cast<unsigned int>(i), null_space[k].value[e]);
    rows.pick(rhs, in);
    const bool is_solved = F.solve_with_null_space(here(set), in, own, load, shift, out, alpha);
    rows.gather(out, x);
    return is_solved;
  }
} // namespace taut
