// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_energy_ordered_h
#define taut_energy_ordered_h

#include "complementarity/energy_descent.h"
#include "complementarity/null_space_penalty.h"

namespace taut
{
  /**
   * The primal active-set method (energy-ordered) on any operator. Use it where SemismoothNewton
   * cycles. It is slower, and assembles a dense matrix first, but it ends for any problem: with the
   * solution, or with the rows or bodies that have none.
   *
   * The method of multipliers holds floating bodies: F + c G^T R G with R of NullSpacePenalty and a
   * large c. alpha is raised by c R (G N + e) until G N + e vanishes. A descent without F first
   * finds whether admissible multipliers can balance the bodies.
   */
  class EnergyOrderedActiveSet
  {
  public:
    enum class Outcome
    {
      finished,      ///< residual() says how well
      contradictory, ///< failed_indices() are rows
      not_held       ///< failed_indices() are null space vectors
    };

    explicit EnergyOrderedActiveSet(const ComplementarityOptions &options) : options(options) {}

    /// Starts from zero multipliers, not from @p solution.
    Outcome solve(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
                  MixedComplementaritySolution &solution);

    const std::vector<std::size_t> &failed_indices() const { return failed; }

    /// Rows closed and opened in the last call.
    unsigned int n_changes() const { return changes; }

    const ComplementarityResidual &residual() const { return final_residual; }

  private:
    Outcome minimize(const MixedComplementarityProblem &problem, DenseOperator &matrix,
                     MixedComplementaritySolution &solution);
    Outcome minimize_with_resistance(const MixedComplementarityProblem &problem,
                                     DenseOperator &matrix, MixedComplementaritySolution &solution);
    Outcome minimize_with_null_space(const MixedComplementarityProblem &problem,
                                     DenseOperator &matrix, MixedComplementaritySolution &solution);
    bool hold(const MixedComplementarityProblem &problem, const DenseOperator &matrix,
              NullSpacePenalty &penalty, double factor, EnergyDescent &descent,
              MixedComplementaritySolution &solution) const;

    ComplementarityOptions options;
    std::vector<std::size_t> failed;
    unsigned int changes = 0;
    ComplementarityResidual final_residual;
  };
} // namespace taut

#endif
