// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_residual_h
#define taut_contact_residual_h

#include "complementarity/problem.h"
#include "time/step_equations.h"
#include <taut/interface/constraints.h>
#include <taut/time/state.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// The residuals of the conditions on the rows after a step, relative to the terms of their gaps.
  class ContactResidual
  {
  public:
    /// The arguments are kept by reference.
    ContactResidual(const Structure &structure, const Constraints &constraints)
        : structure(structure), constraints(constraints)
    {
    }

    /**
     * Largest residual of the solution @p at of a problem, whose gaps are those of the state after
     * the step, and its row. Adds what rounds beside the terms of each gap to the scales of the
     * problem. @p increments are B^T dU, @p S the compliances of the springs. Called by all ranks
     * together.
     */
    double measure(const StepCoefficients &c, MixedComplementarityProblem &problem,
                   const MixedComplementaritySolution &at, const std::vector<double> &increments,
                   const std::vector<double> &S, const State &state, StepEquations &system,
                   std::size_t &worst);

  private:
    void add_decayed_columns(const std::vector<double> &increments, const std::vector<double> &N,
                             const ComplementarityOperator &F, std::vector<double> &scale) const;
    void add_inertial_terms(const StepCoefficients &c, const std::vector<double> &S,
                            const State &state, const ComplementarityOperator &F,
                            std::vector<double> &scale) const;
    void add_elastic_terms(const State &state, const FactoredStructure &bodies,
                           std::vector<double> &scale) const;
    void find(const MixedComplementarityProblem &problem, const MixedComplementaritySolution &at,
              const ComplementarityOperator &F);

    const Structure &structure;
    const Constraints &constraints;
    ComplementarityResidual found;
    std::vector<double> weights, terms;
  };
} // namespace taut

#endif
