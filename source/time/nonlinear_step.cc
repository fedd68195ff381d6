// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/nonlinear_step.h"
#include "base/newton_search.h"
#include "base/text.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Limits of the error of increments, see NonlinearBodies::set_guess(). The first is a tenth of
    /// the default Contact tolerance. If rounding keeps the error above it, the balance of the step
    /// shows the error. A step that needs more iterations is halved.
    constexpr NewtonConvergence::Limits limits_of_step = {1e-9, 1e-5, 2};

    /// Iterations that a whole step may take. Near its end Newton's method doubles the digits, and
    /// five iterations give all of them; one that needs 30 is far off, and two halves of the step
    /// take less.
    constexpr int most_in_step = 30;

    /// Iterations up to which a tangent is kept, by the rate of convergence, also for the next
    /// step. A tangent with its factors costs two or three iterations, but saves fewer.
    constexpr int most_with_a_kept_tangent = 5;

    /// Whether a change after @p before needs more iterations at the same rate.
    bool is_slow(const double change, const double before)
    {
      return !(change * std::pow(change / before, most_with_a_kept_tangent) <=
               limits_of_step.converged);
    }
  } // namespace

  NonlinearStep::NonlinearStep(const Structure &structure, Constraints &constraints,
                               const Reference &reference, const StepMethod &method)
      : structure(structure), constraint_set(constraints), method(method),
        nonlinear(structure, reference, method), turning(constraints, reference, method),
        bodies_are_linear(!structure.communicator().any(!nonlinear.indices().empty()))
  {
    check_masses(constraints);
  }

  /// Requires inertia that resists the force of a turning constraint in all directions.
  void NonlinearStep::check_masses(const Constraints &constraints) const
  {
    if (turning.empty())
      return;
    const std::vector<char> without_mass = constraints.without_mass();
    for (const std::size_t i : constraints.turning_rows())
      if (without_mass[i])
        throw EntryError(constraints.origin(i),
                         "link '" + constraints[i].name +
                             "' turns, and an end of it has no mass. Give that a mass, or a "
                             "'Mass matrix' that is not 'reduced'");
  }

  void NonlinearStep::prepare(const State &state)
  {
    turning.check_method();
    tangents_are_kept = false;
    nonlinear.begin(state);
  }

  void NonlinearStep::follow(const State &state)
  {
    if (turning.empty())
      return;
    turning.follow(state);
    turn();
  }

  void NonlinearStep::linearise(StepEquations &equations) const
  {
    if (bodies_are_linear)
      equations.interface().update_moving();
    else
      equations.linearise();
  }

  /// Largest change of the increments over all ranks.
  double NonlinearStep::set_guess(Step &step, const State &state)
  {
    double change = 0.;
    BodyVectors &dU = step.history().increments();
    step.history().prescribed().impose_increments(dU);
    structure.communicator().agree(
        [&]
        {
          for (const std::size_t k : nonlinear.indices())
          {
            const double own =
                nonlinear.set_guess(k, dU[k], step.equations().bodies().stiffness(k));
            if (!(own <= change) && !std::isnan(change))
              change = own;
          }
        });
    const double of_bodies = structure.communicator().max(
        std::isnan(change) ? std::numeric_limits<double>::infinity() : change);
    if (turning.empty())
      return of_bodies;
    return std::max(of_bodies, turning.set_guess(dU, state, step.contacts().applied().multiplier,
                                                 step.contacts().histories()));
  }

  /// The iterations of one step, from dU = 0. New tangents are those at the last guess.
  class NonlinearStep::Iterations : public NewtonProblem
  {
  public:
    Iterations(NonlinearStep &own, Step &step, State &state, Residuals &residuals)
        : own(own), step(step), state(state), residuals(residuals)
    {
    }

    void begin() override
    {
      n = 0;
      own.multiplier = state.multiplier;
      own.nonlinear.begin(state);
      own.turning.begin();
      own.turn();
      step.costs().lap(StepPart::nonlinear);
      if (!own.tangents_are_kept)
        own.linearise(step.equations());
      else if (!own.turning.empty())
        step.equations().interface().update_moving();
      step.costs().lap(own.tangents_are_kept ? StepPart::moving_rows : StepPart::factors);
      step.equations().begin_search();
      step.set_loads(state);
      own.nonlinear.prescribe(step.history().prescribed());
      own.loads = step.history().loads();
    }

    double solve() override
    {
      BodyVectors &P = step.history().loads();
      P = own.loads;
      for (const std::size_t k : own.nonlinear.indices())
        for (std::size_t i = 0; i < P[k].size(); ++i)
          P[k][i] += own.nonlinear.remainder(k)[i];
      state.multiplier = own.multiplier;
      step.find_increments(state, residuals);
      ++own.iterations;
      ++n;
      before = change;
      change = own.set_guess(step, state);
      step.costs().count_newton();
      step.costs().lap(StepPart::nonlinear);
      return change;
    }

    void go_on() override
    {
      own.turn();
      if (is_redundant() || (n > 1 && is_slow(change, before)))
      {
        own.tangents_are_kept = false;
        own.linearise(step.equations());
        for (const std::size_t k : own.nonlinear.indices())
          own.nonlinear.set_tangent(k, step.equations().bodies().stiffness(k));
        step.costs().lap(StepPart::factors);
      }
      else if (!own.turning.empty())
        step.equations().interface().update_moving();
    }

    bool accept() override
    {
      own.tangents_are_kept = n <= most_with_a_kept_tangent && !is_redundant();
      return true;
    }

  private:
    /// Joints repeat each other to rounding with tangents of their state only.
    bool is_redundant() const { return !step.equations().repeated_rows().empty(); }

    NonlinearStep &own;
    Step &step;
    State &state;
    Residuals &residuals;
    int n = 0;
    double change = 0., before = 0.;
  };

  void NonlinearStep::find_increments(Step &step, State &state, Residuals &residuals)
  {
    const NewtonSearch search(limits_of_step, most_in_step);
    Iterations iterations_of_step(*this, step, state, residuals);
    if (search.find(iterations_of_step))
      return;
    state.multiplier = multiplier;
    const bool once_more = tangents_are_kept;
    tangents_are_kept = false;
    if (once_more && search.find(iterations_of_step))
      return;
    throw UserError(to_text("at t = ", state.time,
                            " s: Newton's method does not converge in a step of ", method.length,
                            " s. Take a smaller step"));
  }
} // namespace taut
