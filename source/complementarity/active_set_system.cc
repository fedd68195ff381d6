// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/active_set_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut
{
  namespace
  {
    /// An iteration ends at this part of the required gaps, while the active set changes and when
    /// it repeats. Some rows are much smaller than the largest row, and s_i is an upper bound only.
    /// From half on, a rough solution may cost another active set; a tenth costs iterations and
    /// saves no set.
    constexpr double rough_part = .3, exact_part = 1e-3;

    /// Rows with a gap below this part of the required one are done. An iteration rounds in all
    /// rows with the largest right-hand side. Where it gains nothing more, the rows that are done
    /// get the right-hand side zero, so that it resolves small rows beside them.
    constexpr double done_part = .1;

    /// Gaps that are rounding, over their terms.
    constexpr double rounding = 1e-16;

    /// Multipliers and gaps that are rounding of rounding, over the largest multiplier (rows scaled
    /// to F_ii = 1).
    constexpr double rounding_of_rounding = 1e-26;

    /// Largest |D_i| / s_i on the set; not-a-number if one is.
    double largest_gap(const std::vector<std::size_t> &set, const std::vector<double> &gap,
                       const std::vector<double> &terms)
    {
      double largest = 0.;
      for (const std::size_t i : set)
        if (!(std::abs(gap[i]) <= largest * terms[i]) && !std::isnan(largest))
          largest = std::abs(gap[i]) / terms[i];
      return largest;
    }

    /// The rounding of an iteration has no end in rows that neither loads nor other rows reach:
    /// each correction leaves a smaller one. Their multipliers and amplitudes are zero.
    void drop_rounding(const MixedComplementarityProblem &problem,
                       const ComplementarityOperator &matrix, const std::vector<std::size_t> &set,
                       MixedComplementaritySolution &solution)
    {
      // Both over the same: N_i sqrt(F_ii) and D_i / sqrt(F_ii) are roots of energies.
      const auto size = [&](const std::size_t i)
      { return std::abs(solution.multiplier[i]) * std::sqrt(matrix.diagonal(i)); };
      double largest = 0.;
      for (const std::size_t i : set)
        largest = std::max(largest, size(i));
      const double rounding = rounding_of_rounding * problem.max(largest);
      for (const std::size_t i : set)
        if (problem.free_gap[i] == 0. && size(i) < rounding)
          solution.multiplier[i] = 0.;

      std::vector<double> &amplitude = solution.mode_amplitude;
      if (amplitude.empty())
        return;
      std::vector<char> is_closed(problem.size(), 0);
      for (const std::size_t i : set)
        is_closed[i] = 1;
      std::vector<double> motions(amplitude.size(), 0.);
      for (std::size_t k = 0; k < amplitude.size(); ++k)
      {
        const LinearForm &mode = problem.null_space[k];
        for (std::size_t e = 0; e < mode.index.size(); ++e)
          if (const std::size_t i = mode.index[e]; is_closed[i])
            motions[k] = std::max(motions[k], problem.free_gap[i] != 0.
                                                  ? std::numeric_limits<double>::infinity()
                                                  : std::abs(mode.value[e] * amplitude[k]) /
                                                        std::sqrt(matrix.diagonal(i)));
      }
      if (problem.shared)
        problem.shared->max(motions);
      for (std::size_t k = 0; k < amplitude.size(); ++k)
        if (motions[k] > 0. && motions[k] < rounding)
          amplitude[k] = 0.;
    }

    /// Largest F_ii |x_i| on the set.
    double largest_step(const std::vector<std::size_t> &set, const ComplementarityOperator &matrix,
                        const std::vector<double> &step)
    {
      double largest = 0.;
      for (const std::size_t i : set)
        largest = std::max(largest, matrix.diagonal(i) * std::abs(step[i]));
      return largest;
    }

    /// The result of one correction.
    struct Sizes
    {
      double gap;  ///< see largest_gap()
      double step; ///< see largest_step(); 0 without a shift
    };

    /// False for amplitudes with a resistance: an operator knows G N = -e only.
    bool solves_with_null_space(const MixedComplementarityProblem &problem,
                                const ComplementarityOperator &matrix)
    {
      return matrix.has_null_space_solver() && !problem.has_resistance();
    }

    /// Solves of others are exact, whatever the search has asked for.
    class RoughSolves
    {
    public:
      explicit RoughSolves(ComplementarityOperator &matrix) : matrix(matrix) {}
      ~RoughSolves() { matrix.set_tolerance(0.); }
      void set_tolerance(const double tolerance) { matrix.set_tolerance(tolerance); }

    private:
      ComplementarityOperator &matrix;
    };
  } // namespace

  ActiveSetSystem::Outcome ActiveSetSystem::solve(const MixedComplementarityProblem &problem,
                                                  ComplementarityOperator &matrix,
                                                  const std::vector<std::size_t> &set,
                                                  const double tolerance,
                                                  MixedComplementaritySolution &solution,
                                                  std::vector<double> &terms)
  {
    start(problem, matrix, set, solution, terms);
    rhs.resize(problem.size());
    shift = 0.;
    null_space_is_ready = false;
    const bool is_exact = tolerance <= options.linear_tolerance;
    const double part = is_exact ? exact_part : rough_part;
    const auto largest = [&] { return problem.max(largest_gap(set, solution.gap, terms)); };
    Sizes now = {matrix.is_iterative() ? largest() : 1., 0.};
    RoughSolves solves(matrix);
    bool is_solved = false, leaves_done_rows = false;
    unsigned int last_correction = options.max_corrections;
    for (unsigned int correction = 0; correction <= last_correction; ++correction)
    {
      solves.set_tolerance(part * tolerance / std::max(now.gap, tolerance));
      if (is_solved)
      {
        before = solution;
        terms_before = terms;
      }
      ask_for(set, solution.gap, terms,
              leaves_done_rows ? std::min(done_part * tolerance, now.gap) : 0.);
      if (!correct(problem, matrix, set, solution))
      {
        if (!is_solved)
          return Outcome::inadmissible;
        break;
      }
      if (matrix.is_iterative())
        drop_rounding(problem, matrix, set, solution);
      gaps(problem, matrix, solution.multiplier, solution.mode_amplitude, solution.gap);
      gap_terms(problem, matrix, solution.multiplier, solution.mode_amplitude, terms);
      const Sizes last = now;
      now = {largest(), shift == 0. ? 0. : problem.max(largest_step(set, matrix, step))};
      if (is_solved && !(now.gap < last.gap))
      {
        solution = before;
        terms = terms_before;
        break;
      }
      // Multipliers of contradictory rows grow by the same step in each correction, and so do the
      // terms of the gaps. With a shift, gaps are therefore small only if the steps get small, too.
      const bool steps_shrink = shift == 0. || (correction > 0 && now.step <= .5 * last.step);
      is_solved = is_solved || !is_exact || (now.gap <= tolerance && steps_shrink);
      // A shift leaves more error in the gaps than rounding, and nearly dependent rows amplify it.
      if (is_solved && (!is_exact || shift == 0. || now.gap <= rounding))
        break;
      if (correction > 0 && !(now.gap < .5 * last.gap && steps_shrink))
      {
        if (!matrix.is_iterative() || shift != 0. || leaves_done_rows)
          break;
        leaves_done_rows = true;
        last_correction += options.max_corrections;
      }
    }
    if (is_solved && problem.n_null_space() > 0 && !solves_with_null_space(problem, matrix))
      balance(problem, matrix, set, solution);
    return is_solved ? Outcome::solved : Outcome::unsettled;
  }

  /// Multipliers and amplitudes to start from, their gaps and terms.
  void ActiveSetSystem::start(const MixedComplementarityProblem &problem,
                              const ComplementarityOperator &matrix,
                              const std::vector<std::size_t> &set,
                              MixedComplementaritySolution &solution,
                              std::vector<double> &terms) const
  {
    std::vector<double> last;
    std::vector<double> amplitude;
    const bool goes_on = matrix.is_iterative() &&
                         !problem.any(solution.multiplier.size() != problem.size() ||
                                      solution.mode_amplitude.size() != problem.n_null_space());
    if (goes_on)
    {
      last.swap(solution.multiplier);
      amplitude.swap(solution.mode_amplitude);
    }
    solution.reset(problem);
    if (!goes_on)
    {
      if (matrix.is_iterative())
        gap_terms(problem, matrix, solution.multiplier, solution.mode_amplitude, terms);
      return;
    }
    for (const std::size_t i : set)
      solution.multiplier[i] = last[i];
    solution.mode_amplitude.swap(amplitude);
    gaps(problem, matrix, solution.multiplier, solution.mode_amplitude, solution.gap);
    gap_terms(problem, matrix, solution.multiplier, solution.mode_amplitude, terms);
  }

  /// Gaps round with the amplitudes, however small the loads are. The last correction is therefore
  /// one of the balance alone, which changes no gap of the set.
  void ActiveSetSystem::balance(const MixedComplementarityProblem &problem,
                                const ComplementarityOperator &matrix,
                                const std::vector<std::size_t> &set,
                                MixedComplementaritySolution &solution)
  {
    std::fill(step.begin(), step.end(), 0.);
    if (!correct_null_space(problem, set, solution))
      return;
    for (const std::size_t i : set)
      solution.multiplier[i] += step[i];
    gaps(problem, matrix, solution.multiplier, solution.mode_amplitude, solution.gap);
  }

  /// The right-hand side of a correction: what is left of the gaps, and zero in rows with |D_i| <
  /// @p done s_i.
  void ActiveSetSystem::ask_for(const std::vector<std::size_t> &set, const std::vector<double> &gap,
                                const std::vector<double> &terms, const double done)
  {
    std::transform(gap.begin(), gap.end(), rhs.begin(), std::negate<double>());
    if (done > 0.)
      for (const std::size_t i : set)
        if (std::abs(gap[i]) < done * terms[i])
          rhs[i] = 0.;
  }

  bool ActiveSetSystem::correct(const MixedComplementarityProblem &problem,
                                ComplementarityOperator &matrix,
                                const std::vector<std::size_t> &set,
                                MixedComplementaritySolution &solution)
  {
    if (problem.n_null_space() > 0 && solves_with_null_space(problem, matrix))
      return correct_with_null_space(problem, matrix, set, solution);
    if (!matrix.solve(set, rhs, shift, step))
    {
      if (shift != 0.)
        return false;
      shift = options.redundancy_shift;
      null_space_is_ready = false;
      if (!matrix.solve(set, rhs, shift, step))
        return false;
    }
    if (problem.n_null_space() > 0)
    {
      if (!null_space_is_ready)
        prepare_null_space(problem, matrix, set);
      if (!correct_null_space(problem, set, solution))
        return false;
    }
    for (const std::size_t i : set)
      solution.multiplier[i] += step[i];
    return true;
  }

  /// One correction with an operator that solves for multipliers and amplitudes at once.
  bool ActiveSetSystem::correct_with_null_space(const MixedComplementarityProblem &problem,
                                                ComplementarityOperator &matrix,
                                                const std::vector<std::size_t> &set,
                                                MixedComplementaritySolution &solution)
  {
    problem.forces_on_null_space(solution.multiplier, unbalance);
    for (std::size_t k = 0; k < problem.n_null_space(); ++k)
      unbalance[k] = -problem.null_space_load[k] - unbalance[k];
    const auto solve = [&]
    {
      return matrix.solve_with_null_space(set, rhs, problem.null_space, unbalance, shift, step,
                                          amplitude);
    };
    if (!solve())
    {
      if (shift != 0.)
        return false;
      shift = options.redundancy_shift;
      if (!solve())
        return false;
    }
    for (const std::size_t i : set)
      solution.multiplier[i] += step[i];
    for (std::size_t k = 0; k < problem.n_null_space(); ++k)
      solution.mode_amplitude[k] += amplitude[k];
    return true;
  }

  void ActiveSetSystem::prepare_null_space(const MixedComplementarityProblem &problem,
                                           ComplementarityOperator &matrix,
                                           const std::vector<std::size_t> &set)
  {
    const std::size_t n_null_space = problem.n_null_space();
    null_space_responses.resize(n_null_space);
    null_space_schur.reinit(n_null_space);
    all_vectors.resize(n_null_space);
    std::iota(all_vectors.begin(), all_vectors.end(), 0);
    for (std::size_t k = 0; k < n_null_space; ++k)
    {
      null_space_rhs.assign(problem.size(), 0.);
      problem.null_space[k].add_to(1., null_space_rhs);
      matrix.solve(set, null_space_rhs, shift, null_space_responses[k]);
      problem.forces_on_null_space(null_space_responses[k], null_space_rhs);
      for (std::size_t l = 0; l <= k; ++l)
        null_space_schur.set(k, l, null_space_rhs[l] + (k == l ? problem.resistance(k) : 0.));
    }
    null_space_is_ready = true;
  }

  // step solves F x = -D on the set. With the share of the amplitudes it also brings G N + e to
  // zero.
  bool ActiveSetSystem::correct_null_space(const MixedComplementarityProblem &problem,
                                           const std::vector<std::size_t> &set,
                                           MixedComplementaritySolution &solution)
  {
    const std::size_t n_null_space = problem.n_null_space();
    problem.forces_on_null_space(solution.multiplier, unbalance);
    problem.forces_on_null_space(step, null_space_rhs);
    for (std::size_t k = 0; k < n_null_space; ++k)
      unbalance[k] = problem.null_space_load[k] + (unbalance[k] + null_space_rhs[k]) -
                     problem.resistance(k) * solution.mode_amplitude[k];
    if (!null_space_schur.solve(all_vectors, unbalance, 0., amplitude))
      return false;
    for (std::size_t k = 0; k < n_null_space; ++k)
    {
      solution.mode_amplitude[k] += amplitude[k];
      for (const std::size_t i : set)
        step[i] -= null_space_responses[k][i] * amplitude[k];
    }
    return true;
  }
} // namespace taut
