// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/solver.h"
#include "base/text.h"
#include "complementarity/whole_problem.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace taut
{
  namespace
  {
    /// By how much multipliers, with the weights of the energy, may change where their part along
    /// repeated rows is taken out: this costs three digits of twelve.
    constexpr double most_cancellation = 1e3;

    std::string list(const std::string &what, const std::vector<std::size_t> &indices)
    {
      std::ostringstream text;
      text << what << (indices.size() == 1 ? "" : "s");
      for (std::size_t i = 0; i < indices.size(); ++i)
        text << (i == 0 ? " " : ", ") << indices[i];
      return text.str();
    }
  } // namespace

  ComplementaritySolver::ComplementaritySolver(const std::string &method,
                                               const ComplementarityOptions &options)
      : method(method), options(options), use_newton(method == "semismooth Newton"),
        use_mprgp(method == "MPRGP"), newton(options), energy_ordered(options)
  {
    if (!use_newton && !use_mprgp && method != "energy-ordered")
      throw UserError("unknown complementarity method '" + method +
                      "'; known are: semismooth Newton, energy-ordered, MPRGP");
  }

  const ComplementarityResult &
  ComplementaritySolver::solve(const MixedComplementarityProblem &problem,
                               ComplementarityOperator &matrix)
  {
    problem.check(matrix);
    try
    {
      check_inert_rows(problem, matrix);
      if (result.solution.closed.size() != problem.size())
        result.solution.closed.assign(problem.size(), problem.n_null_space() > 0);
      result.iterations = 0;
      result.used_fallback = false;
      if (problem.shared)
      {
        solve_shared(problem, matrix);
        return result;
      }
      // A state satisfies its conditions to 1e-9, and so do the rows that follow from them.
      const double exact = is_linearised ? 1e-8 : options.linear_tolerance;
      if (!repeated.empty() && !has_sought)
      {
        has_sought = true;
        repeated.find(problem, matrix, exact);
      }
      for (;;)
      {
        const MixedComplementarityProblem &solved =
            repeated.empty() ? problem : repeated.without(problem);
        bool is_solved = use_newton && solve_with_newton(solved, matrix);
        if (!has_sought && (!use_newton || newton.has_dependent_rows()))
        {
          has_sought = true;
          if (repeated.find(problem, matrix, exact))
            continue;
        }
        if (!is_solved && (use_mprgp || (use_newton && matrix.is_iterative())))
          is_solved = solve_by_products(solved, matrix);
        if (!is_solved)
          solve_energy_ordered(solved, matrix);
        if (spread_over_repeated_rows(problem, matrix))
          break;
      }
    }
    catch (...)
    {
      result.solution.closed.clear();
      throw;
    }
    return result;
  }

  void ComplementaritySolver::solve_shared(const MixedComplementarityProblem &problem,
                                           ComplementarityOperator &matrix)
  {
    const bool repeats = !repeated_rows().empty();
    if (!use_newton || repeats || !solve_with_newton(problem, matrix) ||
        newton.has_dependent_rows())
      solve_whole(problem, matrix);
  }

  /// Solves with all rows on all ranks.
  void ComplementaritySolver::solve_whole(const MixedComplementarityProblem &problem,
                                          ComplementarityOperator &matrix)
  {
    if (!whole)
    {
      whole = std::make_unique<ComplementaritySolver>(method, options);
      if (is_linearised)
        whole->begin_search();
      if (!repeated.empty())
        whole->set_repeated_rows(repeated);
    }
    const SharedRows &rows = *problem.shared;
    const MixedComplementarityProblem all = whole_problem(problem);
    WholeOperator F(matrix, rows);
    whole->start_from(gathered(rows, result.solution.closed));
    const ComplementarityResult &found = whole->solve(all, F);
    rows.pick(found.solution.multiplier, result.solution.multiplier);
    rows.pick(found.solution.gap, result.solution.gap);
    result.solution.mode_amplitude = found.solution.mode_amplitude;
    for (std::size_t i = 0; i < problem.size(); ++i)
      result.solution.closed[i] = found.solution.closed[rows.number(i)];
    result.iterations += found.iterations;
    result.used_fallback = found.used_fallback;
    result.residual = found.residual;
    rows.pick(found.residual.rows, result.residual.rows);
  }

  void ComplementaritySolver::check_inert_rows(const MixedComplementarityProblem &problem,
                                               const ComplementarityOperator &matrix) const
  {
    std::vector<std::size_t> violated;
    const std::vector<char> in_null_space = problem.rows_in_null_space();
    for (std::size_t i = 0; i < problem.size(); ++i)
    {
      const double d = problem.free_gap[i];
      const double scale = problem.gap_scale.empty() ? 0. : problem.gap_scale[i];
      const bool is_open = problem.cones[i].rests_open(0., d);
      if (matrix.diagonal(i) == 0. && (in_null_space.empty() || !in_null_space[i]) && !is_open &&
          std::abs(d) > options.tolerance * (std::abs(d) + scale))
        violated.push_back(problem.shared ? problem.shared->number(i) : i);
    }
    if (problem.any(!violated.empty()))
      throw ContradictoryRows("nothing that moves could close the gap of " + list("row", violated) +
                                  ": connect them to something that is free, or change the gaps",
                              violated);
  }

  /// False if rows that take no part are left with gaps, so that they do not repeat others.
  bool ComplementaritySolver::spread_over_repeated_rows(const MixedComplementarityProblem &problem,
                                                        const ComplementarityOperator &matrix)
  {
    if (repeated.empty())
      return true;
    MixedComplementaritySolution &solution = result.solution;
    const auto size = [&]
    {
      double sum = 0.;
      for (std::size_t i = 0; i < problem.size(); ++i)
        sum += matrix.diagonal(i) * std::pow(solution.multiplier[i], 2);
      return std::sqrt(sum);
    };
    const double before = size();
    repeated.spread(problem, matrix, solution.multiplier);
    gaps(problem, matrix, solution.multiplier, solution.mode_amplitude, solution.gap);
    if (is_linearised)
      return true;
    gap_terms(problem, matrix, solution.multiplier, solution.mode_amplitude, terms);
    // What is much larger on one side has lost the digits of the other one.
    const double after = size();
    bool is_exact = std::max(before, after) <= most_cancellation * std::min(before, after);
    for (std::size_t i = 0; i < problem.size(); ++i)
      is_exact = is_exact && !(problem.cones[i].is_free() &&
                               std::fabs(solution.gap[i]) > options.linear_tolerance * terms[i]);
    if (!is_exact)
      repeated = {};
    return is_exact;
  }

  bool ComplementaritySolver::solve_with_newton(const MixedComplementarityProblem &problem,
                                                ComplementarityOperator &matrix)
  {
    const auto outcome = newton.solve(problem, matrix, result.solution);
    result.iterations += newton.n_iterations();
    result.residual = newton.residual();
    return outcome == SemismoothNewton::Outcome::solved && result.residual.max <= options.tolerance;
  }

  /// By products with F; the active set is then solved exactly.
  bool ComplementaritySolver::solve_by_products(const MixedComplementarityProblem &problem,
                                                ComplementarityOperator &matrix)
  {
    const bool is_found = mprgp.solve(problem, matrix, result.solution);
    result.iterations += mprgp.n_changes();
    result.used_fallback = use_newton;
    if (!is_found)
      return false;
    result.residual = mprgp.residual();
    const ComplementarityResult found = result;
    if (solve_with_newton(problem, matrix))
      return true;
    result = found;
    return result.residual.max <= options.tolerance;
  }

  void ComplementaritySolver::solve_energy_ordered(const MixedComplementarityProblem &problem,
                                                   ComplementarityOperator &matrix)
  {
    using Outcome = EnergyOrderedActiveSet::Outcome;
    const Outcome outcome = energy_ordered.solve(problem, matrix, result.solution);
    result.iterations += energy_ordered.n_changes();
    result.used_fallback = use_newton || use_mprgp;
    result.residual = energy_ordered.residual();

    const std::vector<std::size_t> &failed = energy_ordered.failed_indices();
    if (outcome == Outcome::contradictory)
      throw ContradictoryRows("the gaps of " + list("row", failed) +
                                  " contradict each other: remove one of them, or make one elastic",
                              failed);
    if (outcome == Outcome::not_held)
      throw BodyNotHeld("no admissible multiplier balances the load on " +
                            list("null space vector", failed) + ": hold the body",
                        failed);
    if (result.residual.max <= options.tolerance)
      return;
    // Newton's method solves for small multipliers separately from large gaps. It starts from the
    // active set found, or from all rows if this set leaves a body free.
    const double missed = result.residual.max;
    result.used_fallback = !use_newton;
    if (solve_with_newton(problem, matrix))
      return;
    if (problem.n_null_space() > 0)
    {
      result.solution.closed.assign(problem.size(), 1);
      if (solve_with_newton(problem, matrix))
        return;
    }
    throw NotSolved(to_text("the complementarity problem is not solved: its residual is ", missed,
                            ", more than ", options.tolerance,
                            "; check the free gaps, or raise the tolerance"));
  }
} // namespace taut
