// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_h
#define taut_step_h

#include "time/balance_residual.h"
#include "time/body_step.h"
#include "time/contact_step.h"
#include "time/step_check.h"
#include "time/step_equations.h"
#include <taut/time/residuals.h>
#include <taut/time/step_costs.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * One step of all bodies and constraints, in time or at rest:
   *
   *     set_loads()        P^_k                               BodyStep
   *     find_increments()  N, and A_k dU_k = P^_k + B_k N     ContactStep, StepEquations
   *     accept()           U, V, A, r, and gaps               BodyStep, ContactStep
   *     certify()          residuals of both, once more       BalanceResidual, ContactStep
   *                        with the residual if it is large
   *
   * Motion takes steps in time, by the method of a scheme. StaticStep takes steps of a search of an
   * equilibrium, with A = K. All functions with a state are called by all ranks
   * together.
   */
  class Step
  {
  public:
    /// All but @p start are kept by reference. @p bodies and @p turning are empty, or follow the
    /// guesses of Newton's method.
    Step(const Structure &structure, const Constraints &constraints,
         const SolverParameters &parameters, const Reference &reference, const StepMethod &method,
         const NonlinearBodies &bodies, const TurningConstraints &turning, const State &start);

    /// After a change of the method: factors A, and sets F up. A linear system keeps both for the
    /// coefficients of the last calls, see most_kept() in the source.
    void prepare();

    /// Discards factors, F and searches; prepare() makes them anew.
    void reset();

    /// Sets history().loads() to P^ of a step from the state @p before to its time.
    void set_loads(State &before);

    /// Finds N, and history().increments() from P^. Counts iterations in @p residuals.
    void find_increments(State &state, Residuals &residuals);

    /// Sets displacements, velocities, accelerations and gaps at the end of the step.
    void accept(State &state);

    /// The same, and K U, the balance r, and its residual.
    void accept(State &state, Residuals &residuals);

    /// Sets K U and the balance of a state, and its residual in @p residuals.
    void measure_balance(State &state, Residuals &residuals);

    /// Solves for the forces in history().loads() beside those of the step, and for what closed
    /// constraints lack, and adds the answer to the state. @p on_modes are the same forces for the
    /// rigid body modes of bodies that only constraints hold. False, without changes, if the
    /// constraints have no solution.
    bool correct(State &state, const BodyVectors &on_modes);

    /// Certifies an accepted step whose balance is measured; repeats a step that lost digits.
    /// Throws UserError if the residuals exceeds the contact tolerance.
    void certify(State &state, Residuals &residuals);

    StepEquations &equations() { return *kept.front().equations; }
    const StepEquations &equations() const { return *kept.front().equations; }
    ContactStep &contacts() { return own_contacts; }
    const ContactStep &contacts() const { return own_contacts; }
    StepReport &report() { return own_report; }
    const StepReport &report() const { return own_report; }
    BodyStep &history() { return own_history; }
    const BodyStep &history() const { return own_history; }
    const BalanceResidual &balance() const { return own_balance; }
    StepCheck &check() { return own_check; }
    StepCosts &costs() { return own_costs; }
    const StepCosts &costs() const { return own_costs; }

    /// Counts of the interface operator over all steps.
    InterfaceStatistics interface_statistics() const;

  private:
    /// Equations with the coefficients that they are prepared for.
    struct ReusedValues
    {
      StepCoefficients c;
      std::unique_ptr<StepEquations> equations;
      bool is_prepared = false;
    };

    ReusedValues make_equations() const;
    std::size_t most_kept() const;
    bool refine(State &state);

    const Structure &structure;
    const Constraints &constraints;
    const SolverParameters &parameters;
    const StepMethod &method;
    const NonlinearBodies &bodies;
    const TurningConstraints &turning;
    std::vector<ReusedValues> kept; ///< the last ones first
    InterfaceStatistics earlier;    ///< statistics of equations before reset()
    ContactStep own_contacts;
    BodyStep own_history;
    BalanceResidual own_balance;
    StepCheck own_check;
    StepReport own_report;
    StepCosts own_costs;
  };
} // namespace taut

#endif
