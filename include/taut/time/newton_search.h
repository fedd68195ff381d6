// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_newton_search_h
#define taut_newton_search_h

#include <taut/time/contact_conditions.h>
#include <taut/time/nonlinear_bodies.h>
#include <taut/time/step_history.h>
#include <taut/time/turning_constraints.h>

#include <functional>
#include <vector>

namespace taut
{
  /**
   * Newton's method through the steps, for bodies that are not linear and constraints that turn.
   * The complementarity problem of each linearisation is solved exactly (N. H. Josephy, 1979). All
   * functions but those that return what is known are called by all ranks together.
   */
  class NewtonSearch
  {
  public:
    /// The arguments are kept by reference.
    NewtonSearch(const Structure &structure, Constraints &constraints, const Reference &reference);

    /// True if all bodies of all ranks are linear and no constraint turns: there is nothing to
    /// search for.
    bool is_linear() const { return bodies_are_linear && turning.empty(); }

    /// Gives the equations the tangents of the bodies.
    void attach(StepEquations &equations) const;

    /// For steps of length @p step [s] with these coefficients, from @p state on. Throws EntryError
    /// for a scheme that does not suit constraints that turn.
    void prepare(const StepCoefficients &c, double step, const State &state);

    /// Takes the directions of the constraints from a state.
    void follow(const State &state) { turning.follow(state); }

    /// What a search works on: the state before the step, which gets its multipliers, P^ of the
    /// step into StepHistory::loads(), and what makes increments of P^.
    struct Step
    {
      State &state;
      StepEquations &equations;
      StepHistory &history;
      const ContactConditions &conditions;
      std::function<void()> set_loads, find_increments;
    };

    /// Finds the increments, with the tangent of a step before while that pays. Throws UserError if
    /// the iterations do not converge.
    void find_increments(const Step &step);

    NonlinearBodies &bodies() { return nonlinear; }
    const TurningConstraints &constraints() const { return turning; }

    /// Solves so far; 0 if is_linear().
    long n_iterations() const { return iterations; }

  private:
    void check_masses(const Constraints &constraints) const;
    bool iterate(const Step &step);
    void linearise(StepEquations &equations) const;
    double set_guess(const Step &step);

    const Structure &structure;
    NonlinearBodies nonlinear;
    TurningConstraints turning;
    bool bodies_are_linear;         ///< of all ranks
    bool tangents_are_kept = false; ///< from step to step
    StepCoefficients c;
    double length = 0.; ///< of a step [s]
    long iterations = 0;
  };
} // namespace taut

#endif
