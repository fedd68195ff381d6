// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_nonlinear_step_h
#define taut_nonlinear_step_h

#include "time/nonlinear_bodies.h"
#include "time/step.h"
#include "time/turning_constraints.h"

namespace taut
{
  /**
   * Steps of bodies that are not linear, and of constraints that turn: NewtonSearch through linear
   * steps. The complementarity problem of each linearisation is solved exactly (N. H. Josephy,
   * 1979). All functions but those that return what is known are called by all ranks together.
   */
  class NonlinearStep
  {
  public:
    /// The arguments are kept by reference.
    NonlinearStep(const Structure &structure, Constraints &constraints, const Reference &reference,
                  const StepMethod &method);

    /// True if all bodies of all ranks are linear and no constraint turns: there is nothing to
    /// search for.
    bool is_linear() const { return bodies_are_linear && turning.empty(); }

    /// After a change of the method, for steps from @p state on. Throws EntryError for a scheme
    /// that does not suit constraints that turn.
    void prepare(const State &state);

    /// Takes the directions of the constraints from a state.
    void follow(const State &state);

    /// The same after a step was taken back: tangents of its end are not kept.
    void return_to(const State &state)
    {
      tangents_are_kept = false;
      follow(state);
    }

    /// Finds the increments of a step from @p state, with the tangent of a step before while that
    /// pays; the state gets the multipliers. Throws UserError if the iterations do not converge.
    void find_increments(Step &step, State &state, Residuals &residuals);

    NonlinearBodies &bodies() { return nonlinear; }
    const TurningConstraints &constraints() const { return turning; }

    /// Solves so far; 0 if is_linear().
    long n_iterations() const { return iterations; }

  private:
    class Iterations;
    void check_masses(const Constraints &constraints) const;
    void linearise(StepEquations &equations) const;
    double set_guess(Step &step, const State &state);
    void turn() { constraint_set.turn(turning.directions()); }

    const Structure &structure;
    Constraints &constraint_set;
    const StepMethod &method;
    NonlinearBodies nonlinear;
    TurningConstraints turning;
    bool bodies_are_linear;         ///< of all ranks
    bool tangents_are_kept = false; ///< from step to step
    long iterations = 0;
    BodyVectors loads;              ///< P^ of the step, without remainders
    std::vector<double> multiplier; ///< before the step
  };
} // namespace taut

#endif
