// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_static_step_h
#define taut_static_step_h

#include "softer_bodies.h"

#include <taut/time/constraint_laws.h>
#include <taut/time/static_equilibrium.h>
#include <taut/time/step_check.h>
#include <taut/time/step_equations.h>

#include <vector>

namespace taut
{
  /// The step from a state U, at first the undeformed one, to f(U) + K dU = P + B N.
  class StaticStep
  {
  public:
    StaticStep(const Structure &structure, const Constraints &constraints,
               const SolverParameters &parameters, double t, const SofterBodies &bodies,
               const BodyVectors &from);
    StaticState solve();
    void certify(StaticState &state);

    /// True if all tangents are those of the bodies and positive definite.
    bool has_own_tangents() const { return system.has_own_tangents(); }

    /**
     * After solve(): the displacements along springs of the constraints, given by their @p rows,
     * that unit forces along each of them cause, with all other closed constraints closed and
     * those that just touch, too [m/N]. False if there is no such answer, as of a body that nothing
     * holds.
     */
    bool flexibility(const std::vector<std::size_t> &rows,
                     std::vector<std::vector<double>> &result);

    const FactoredStructure &bodies() const { return system.bodies(); }

  private:
    void set_loads();
    void set_problem();
    void find_multipliers();
    void fail_not_held(const BodyNotHeld &e) const;
    StaticState displaced(const MixedComplementaritySolution &by) const;
    double find_remainder(const StaticState &state, MixedComplementarityProblem &remainder) const;
    void refine(StaticState &state);

    /// Of each constraint, the sum of the sizes of the motions that its gap is made of [m, rad].
    std::vector<double> motion_terms(const BodyVectors &U) const;
    BodyVectors terms_of(const BodyVectors &U) const;
    ComplementarityResidual residual_of_gaps(const StaticState &state);

    const Structure &structure;
    const Constraints &constraints;
    const SofterBodies &soft;
    const BodyVectors &from;
    const Communicator &processes;
    const double time;
    StepCheck check;
    StepEquations system;
    ConstraintLaws laws;
    std::vector<double> compliance, shift; ///< of springs; of linearised laws
    BodyVectors P, lift;
    std::vector<double> work;
    MixedComplementarityProblem problem;
    MixedComplementaritySolution solution;
    Certificate certificate;
  };
} // namespace taut

#endif
