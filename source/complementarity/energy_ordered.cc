// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/energy_ordered.h"
#include "complementarity/active_set_system.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// The factor c of F + c G^T R G: each update of alpha gains about three digits of balance, and
    /// costs three digits of rounding.
    constexpr double null_space_factor = 1e3;

    /// Largest number of updates of alpha; some five are enough for bodies that are held well.
    constexpr unsigned int max_updates = 60;

    /// Balance below which alpha is no longer updated: a hundred roundings, the end of five
    /// updates.
    constexpr double balanced = 1e-14;

    /// Unbalanced part of a load above which nothing can balance the load: a descent finds zero as
    /// the root of its rounding, 1e-8.
    constexpr double not_held = 1e-7;

    void add(std::vector<double> &y, double factor, const std::vector<double> &x)
    {
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] += factor * x[i];
    }

    /// 1 if F has entries; otherwise the ratio of length and force that gives the penalty the size
    /// of the gaps.
    double compliance(const MixedComplementarityProblem &problem, const DenseOperator &matrix,
                      const std::vector<double> &multiplier)
    {
      double gap = 0., force = 0.;
      for (std::size_t i = 0; i < problem.size(); ++i)
      {
        if (matrix.diagonal(i) > 0.)
          return 1.;
        gap = std::max(gap, std::abs(problem.free_gap[i]));
        force = std::max(force, std::abs(multiplier[i]));
      }
      return gap > 0. && force > 0. ? gap / force : 1.;
    }

    /**
     * alpha has rounding errors of the size of the penalty. The gaps of the closed rows determine
     * alpha more accurately, if they determine it at all. Otherwise an amplitude that is rounding
     * is set to zero.
     */
    void settle_amplitude(const MixedComplementarityProblem &problem, const DenseOperator &matrix,
                          NullSpacePenalty &penalty, double factor,
                          MixedComplementaritySolution &solution)
    {
      std::vector<char> closed(problem.size());
      for (std::size_t i = 0; i < problem.size(); ++i)
        closed[i] = problem.cones[i].is_closed(solution.multiplier[i]);
      gaps(problem, matrix, solution.multiplier, solution.mode_amplitude, solution.gap);
      NullSpacePenalty closed_rows(problem, matrix, closed);
      add(solution.mode_amplitude, 1., closed_rows.closing_amplitude(solution.gap));

      const std::vector<double> terms = penalty.amplitude_terms(solution.multiplier);
      for (std::size_t k = 0; k < terms.size(); ++k)
        if (std::abs(solution.mode_amplitude[k]) <= 1e-15 * factor * terms[k])
          solution.mode_amplitude[k] = 0.;
    }

    /**
     * Solves the active set as one system with alpha, which is exact if the set holds the bodies.
     * The solution is kept if it is better. @p held has the same solutions with d + c G^T R e.
     */
    void polish(const MixedComplementarityProblem &problem, const DenseOperator &matrix,
                NullSpacePenalty &penalty, double factor, DenseOperator &held,
                const std::vector<std::size_t> &set, const ComplementarityOptions &options,
                MixedComplementaritySolution &solution)
    {
      std::vector<double> load(problem.n_null_space(), 0.), terms;
      add(load, factor, penalty.weigh(problem.null_space_load));
      MixedComplementarityProblem held_problem = problem;
      held_problem.free_gap =
          penalty.without_null_space(problem.free_gap, problem.free_gap, load).free_gap;

      MixedComplementaritySolution candidate = solution;
      if (ActiveSetSystem(options).solve(held_problem, held, set, options.linear_tolerance,
                                         candidate, terms) != ActiveSetSystem::Outcome::solved)
        return;
      add(candidate.mode_amplitude, factor, penalty.weigh(penalty.unbalance(candidate.multiplier)));
      for (MixedComplementaritySolution *const either : {&solution, &candidate})
        gaps(problem, matrix, either->multiplier, either->mode_amplitude, either->gap);
      if (residual(problem, matrix, candidate).max < residual(problem, matrix, solution).max)
        solution = candidate;
    }

    DenseOperator assemble(const ComplementarityOperator &matrix)
    {
      if (const auto *const dense = dynamic_cast<const DenseOperator *>(&matrix))
        return *dense;
      const std::size_t n = matrix.size();
      DenseOperator result(n);
      std::vector<double> unit(n, 0.), column;
      for (std::size_t j = 0; j < n; ++j)
      {
        unit[j] = 1.;
        matrix.apply(unit, column);
        unit[j] = 0.;
        for (std::size_t i = j; i < n; ++i)
          result.set(i, j, column[i]);
      }
      return result;
    }
  } // namespace

  EnergyOrderedActiveSet::Outcome
  EnergyOrderedActiveSet::solve(const MixedComplementarityProblem &problem,
                                const ComplementarityOperator &matrix,
                                MixedComplementaritySolution &solution)
  {
    failed.clear();
    changes = 0;
    solution.reset(problem);
    DenseOperator dense = assemble(matrix);
    const Outcome outcome = problem.n_null_space() == 0 ? minimize(problem, dense, solution)
                            : problem.has_resistance()
                                ? minimize_with_resistance(problem, dense, solution)
                                : minimize_with_null_space(problem, dense, solution);

    final_residual = close_rows(problem, matrix, solution);
    return outcome;
  }

  EnergyOrderedActiveSet::Outcome
  EnergyOrderedActiveSet::minimize(const MixedComplementarityProblem &problem,
                                   DenseOperator &matrix, MixedComplementaritySolution &solution)
  {
    EnergyDescent descent(options);
    const bool is_consistent = descent.start(problem, matrix) && descent.descend(problem, matrix);
    changes += descent.n_changes();
    solution.multiplier = descent.multiplier();
    failed = is_consistent ? std::vector<std::size_t>() : descent.contradictory_rows();
    return is_consistent ? Outcome::finished : Outcome::contradictory;
  }

  /// Eliminates amplitudes with a resistance, alpha = E^-1 (G N + e). The active set found so is
  /// then solved with these amplitudes as unknowns, because F is small beside G^T E^-1 G.
  EnergyOrderedActiveSet::Outcome
  EnergyOrderedActiveSet::minimize_with_resistance(const MixedComplementarityProblem &problem,
                                                   DenseOperator &matrix,
                                                   MixedComplementaritySolution &solution)
  {
    DenseOperator whole = matrix;
    MixedComplementarityProblem without = problem;
    without.null_space.clear();
    without.null_space_load.clear();
    without.null_space_resistance.clear();
    without.gap_scale.resize(problem.size(), 0.);
    std::vector<std::size_t> resisted, free;
    for (std::size_t k = 0; k < problem.n_null_space(); ++k)
    {
      const LinearForm &G = problem.null_space[k];
      if (!(problem.resistance(k) > 0.))
      {
        without.null_space.push_back(G);
        without.null_space_load.push_back(problem.null_space_load[k]);
        free.push_back(k);
        continue;
      }
      resisted.push_back(k);
      const double amplitude = problem.null_space_load[k] / problem.resistance(k);
      for (std::size_t e = 0; e < G.index.size(); ++e)
      {
        const std::size_t i = G.index[e];
        without.free_gap[i] += G.value[e] * amplitude;
        without.gap_scale[i] += std::abs(G.value[e] * amplitude);
        for (std::size_t f = 0; f < G.index.size(); ++f)
          if (G.index[f] <= i)
            whole.set(i, G.index[f],
                      whole(i, G.index[f]) + G.value[e] * G.value[f] / problem.resistance(k));
      }
    }
    MixedComplementaritySolution part;
    part.reset(without);
    const Outcome outcome = free.empty() ? minimize(without, whole, part)
                                         : minimize_with_null_space(without, whole, part);
    if (outcome == Outcome::not_held)
      for (std::size_t &k : failed)
        k = free[k];
    solution.multiplier = part.multiplier;
    for (std::size_t k = 0; k < free.size(); ++k)
      solution.mode_amplitude[free[k]] = part.mode_amplitude[k];
    for (const std::size_t k : resisted)
      solution.mode_amplitude[k] =
          (problem.null_space[k].dot(solution.multiplier) + problem.null_space_load[k]) /
          problem.resistance(k);
    std::vector<std::size_t> set;
    for (std::size_t i = 0; i < problem.size(); ++i)
      if (solution.multiplier[i] != 0.)
        set.push_back(i);
    std::vector<double> terms;
    MixedComplementaritySolution candidate = solution;
    if (ActiveSetSystem(options).solve(problem, matrix, set, options.linear_tolerance, candidate,
                                       terms) == ActiveSetSystem::Outcome::solved)
    {
      gaps(problem, matrix, solution.multiplier, solution.mode_amplitude, solution.gap);
      if (taut::residual(problem, matrix, candidate).max <
          taut::residual(problem, matrix, solution).max)
        solution = candidate;
    }
    return outcome;
  }

  EnergyOrderedActiveSet::Outcome
  EnergyOrderedActiveSet::minimize_with_null_space(const MixedComplementarityProblem &problem,
                                                   DenseOperator &matrix,
                                                   MixedComplementaritySolution &solution)
  {
    // Gaps are as accurate as the terms of the penalty allow; these terms must not widen the dead
    // band.
    ComplementarityOptions null_space_options = options;
    null_space_options.dead_band /= null_space_factor;
    EnergyDescent descent(null_space_options);
    NullSpacePenalty penalty(problem, matrix, std::vector<char>(problem.size(), 1));

    // N >= 0 with the least unbalance: a descent with G^T R G and G^T R e alone.
    DenseOperator projector(problem.size());
    penalty.add_to(projector, 1.);
    const std::vector<double> zeros(problem.size(), 0.);
    const auto balance =
        penalty.without_null_space(zeros, zeros, penalty.weigh(problem.null_space_load));
    descent.start(balance, projector);
    descent.descend(balance, projector);
    changes += descent.n_changes();
    failed = penalty.unbalanced(descent.multiplier(), not_held);
    if (!failed.empty())
      return Outcome::not_held;

    const double factor = null_space_factor * compliance(problem, matrix, descent.multiplier());
    const bool is_consistent = hold(problem, matrix, penalty, factor, descent, solution);
    changes += descent.n_changes();
    failed = is_consistent ? std::vector<std::size_t>() : descent.contradictory_rows();
    return is_consistent ? Outcome::finished : Outcome::contradictory;
  }

  bool EnergyOrderedActiveSet::hold(const MixedComplementarityProblem &problem,
                                    const DenseOperator &matrix, NullSpacePenalty &penalty,
                                    double factor, EnergyDescent &descent,
                                    MixedComplementaritySolution &solution) const
  {
    DenseOperator held = matrix;
    penalty.add_to(held, factor);
    std::vector<double> terms;
    for (unsigned int update = 0; update < max_updates; ++update)
    {
      gap_terms(problem, matrix, solution.multiplier, solution.mode_amplitude, terms);
      std::vector<double> amplitude = solution.mode_amplitude;
      add(amplitude, factor, penalty.weigh(problem.null_space_load));
      const auto problem_at = penalty.without_null_space(problem.free_gap, terms, amplitude);
      if ((update == 0 && !descent.start(problem_at, held)) || !descent.descend(problem_at, held))
        return false;
      solution.multiplier = descent.multiplier();
      add(solution.mode_amplitude, factor, penalty.weigh(penalty.unbalance(solution.multiplier)));
      if (penalty.unbalanced(solution.multiplier, balanced).empty())
        break;
    }

    settle_amplitude(problem, matrix, penalty, factor, solution);
    polish(problem, matrix, penalty, factor, held, descent.set(), options, solution);
    return true;
  }
} // namespace taut
