// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/complementarity/energy_ordered.h>

namespace taut
{
  namespace
  {
    /// c of F + c G^T R G: each update of alpha gains about three digits of balance, for three
    /// digits of rounding.
    constexpr double kernel_factor = 1e3;

    /// Updates of alpha; some five are enough where the bodies are held well.
    constexpr unsigned int max_updates = 60;

    /// Balance at which alpha is not updated any more.
    constexpr double balanced = 1e-14;

    /// Unbalanced part of a load that nothing can balance: a descent finds zero as the root of its
    /// rounding.
    constexpr double not_held = 1e-7;

    void add(std::vector<double> &y, double factor, const std::vector<double> &x)
    {
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] += factor * x[i];
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
    const Outcome outcome = problem.n_kernel() == 0
                                ? minimize(problem, dense, solution)
                                : minimize_with_kernel(problem, dense, solution);

    std::vector<double> terms, weights;
    gaps(problem, matrix, solution.multiplier, solution.kernel_amplitude, solution.gap);
    gap_terms(problem, matrix, solution.multiplier, solution.kernel_amplitude, terms);
    multiplier_weights(problem, matrix, solution.multiplier, terms, weights);
    taut::residual(problem, solution, terms, weights, final_residual);
    for (std::size_t i = 0; i < problem.size(); ++i)
      solution.closed[i] = problem.unilateral[i] ? solution.multiplier[i] > 0. : weights[i] > 0.;
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

  EnergyOrderedActiveSet::Outcome
  EnergyOrderedActiveSet::minimize_with_kernel(const MixedComplementarityProblem &problem,
                                               DenseOperator &matrix,
                                               MixedComplementaritySolution &solution)
  {
    // Gaps are accurate to rounding of the penalty's terms; its dead band must not be wider than
    // that of the rows.
    ComplementarityOptions kernel_options = options;
    kernel_options.dead_band /= kernel_factor;
    EnergyDescent descent(kernel_options);
    KernelPenalty penalty(problem, matrix);

    // N >= 0 with the least unbalance: the same descent with G^T R G and G^T R e alone.
    DenseOperator projector(problem.size());
    penalty.add_to(projector, 1.);
    const auto balance = penalty.without_kernel(std::vector<double>(problem.size(), 0.),
                                                penalty.weigh(problem.kernel_load));
    descent.start(balance, projector);
    descent.descend(balance, projector);
    changes += descent.n_changes();
    failed = penalty.unbalanced(descent.multiplier(), not_held);
    if (!failed.empty())
      return Outcome::not_held;

    penalty.add_to(matrix, kernel_factor);
    bool is_consistent = true;
    for (unsigned int update = 0; update < max_updates && is_consistent; ++update)
    {
      std::vector<double> amplitude = solution.kernel_amplitude;
      add(amplitude, kernel_factor, penalty.weigh(problem.kernel_load));
      const auto held = penalty.without_kernel(problem.free_gap, amplitude);
      is_consistent = (update > 0 || descent.start(held, matrix)) && descent.descend(held, matrix);
      solution.multiplier = descent.multiplier();
      add(solution.kernel_amplitude, kernel_factor,
          penalty.weigh(penalty.unbalance(solution.multiplier)));
      if (penalty.unbalanced(solution.multiplier, balanced).empty())
        break;
    }
    changes += descent.n_changes();
    failed = is_consistent ? std::vector<std::size_t>() : descent.contradictory_rows();
    return is_consistent ? Outcome::finished : Outcome::contradictory;
  }
} // namespace taut
