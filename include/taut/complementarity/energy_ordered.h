// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_energy_ordered_h
#define taut_energy_ordered_h

#include <taut/complementarity/energy_descent.h>
#include <taut/complementarity/null_space_penalty.h>

namespace taut
{
  /**
   * The energy-ordered active set on any operator, assembled into a dense matrix first: slower than
   * Newton's method, but it ends, whatever the problem, with the solution or with the rows or
   * bodies that have none.
   *
   * Floating bodies are held by the method of multipliers: F + c G^T R G with the penalty's R and a
   * large c, and alpha raised by c R (G N + e) until this vanishes. Whether admissible multipliers
   * can balance the bodies at all is found out before, by the same descent without F.
   */
  class EnergyOrderedActiveSet
  {
  public:
    enum class Outcome
    {
      finished,      ///< residual() tells how well
      contradictory, ///< failed_indices() are rows
      not_held       ///< failed_indices() are null space vectors
    };

    explicit EnergyOrderedActiveSet(const ComplementarityOptions &options) : options(options) {}

    /// Starts from zero multipliers, not from the solution that is handed in.
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
