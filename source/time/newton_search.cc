// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/time/newton_convergence.h>
#include <taut/time/newton_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Limits of the error of increments, see NonlinearBodies::set_guess(). If rounding keeps it
    /// above the first limit, the balance of the step shows the error.
    constexpr NewtonConvergence::Limits limits = {1e-9, 1e-5, 2};

    /// Iterations up to which a tangent is kept, by the rate of convergence, also for the next
    /// step. A tangent with its factors costs two or three iterations, but saves fewer.
    constexpr int most_with_a_kept_tangent = 5;
    constexpr int most_iterations = 30;

    /// Whether a change after @p before needs more iterations at the same rate.
    bool is_slow(const double change, const double before)
    {
      return !(change * std::pow(change / before, most_with_a_kept_tangent) <= limits.converged);
    }
  } // namespace

  NewtonSearch::NewtonSearch(const Structure &structure, Constraints &constraints,
                             const Reference &reference)
      : structure(structure), constraint_set(constraints), nonlinear(structure, reference),
        turning(constraints, reference),
        bodies_are_linear(!structure.communicator().any(!nonlinear.indices().empty()))
  {
    check_masses(constraints);
  }

  /// Requires inertia that resists the force of a turning constraint in all directions.
  void NewtonSearch::check_masses(const Constraints &constraints) const
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

  void NewtonSearch::prepare(const StepCoefficients &coefficients, const double step,
                             const State &state)
  {
    turning.prepare(coefficients);
    c = coefficients;
    length = step;
    tangents_are_kept = false;
    nonlinear.begin(state, c, length);
  }

  void NewtonSearch::follow(const State &state)
  {
    if (turning.empty())
      return;
    turning.follow(state);
    turn();
  }

  void NewtonSearch::linearise(StepEquations &equations) const
  {
    if (bodies_are_linear)
      equations.interface().update_moving();
    else
      equations.linearise();
  }

  /// Largest change of the increments over all ranks.
  double NewtonSearch::set_guess(Step &step, const State &state)
  {
    double change = 0.;
    BodyVectors &dU = step.history().increments();
    step.history().impose_lift(dU);
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
    return std::max(of_bodies, turning.set_guess(dU, state, step.conditions().applied().multiplier,
                                                 step.conditions().springs().histories()));
  }

  void NewtonSearch::find_increments(Step &step, State &state, Certificate &certificate)
  {
    if (iterate(step, state, certificate))
      return;
    if (tangents_are_kept)
    {
      tangents_are_kept = false;
      if (iterate(step, state, certificate))
        return;
    }
    throw UserError(to_text("at t = ", state.time,
                            " s: Newton's method does not converge in a step of ", length,
                            " s. Take a smaller step"));
  }

  /// Iterates from dU = 0; new tangents are those at the last guess.
  bool NewtonSearch::iterate(Step &step, State &state, Certificate &certificate)
  {
    const std::vector<double> multiplier = state.multiplier;
    nonlinear.begin(state, c, length);
    turning.begin(c);
    turn();
    if (!tangents_are_kept)
      linearise(step.equations());
    else if (!turning.empty())
      step.equations().interface().update_moving();
    step.set_loads(state);
    const BodyVectors loads = step.history().loads();
    NewtonConvergence convergence(limits);
    double before = std::numeric_limits<double>::infinity();
    for (int iteration = 1; iteration <= most_iterations; ++iteration)
    {
      BodyVectors &P = step.history().loads();
      P = loads;
      for (const std::size_t k : nonlinear.indices())
        for (std::size_t i = 0; i < P[k].size(); ++i)
          P[k][i] += nonlinear.remainder(k)[i];
      state.multiplier = multiplier;
      step.find_increments(state, certificate);
      ++iterations;
      const double change = set_guess(step, state);
      const NewtonConvergence::Verdict verdict = convergence.add(change);
      if (verdict == NewtonConvergence::Verdict::converged)
      {
        tangents_are_kept = iteration <= most_with_a_kept_tangent;
        return true;
      }
      if (verdict == NewtonConvergence::Verdict::failed)
        return false;
      turn();
      if (iteration > 1 && is_slow(change, before))
      {
        tangents_are_kept = false;
        linearise(step.equations());
        for (const std::size_t k : nonlinear.indices())
          nonlinear.set_tangent(k, step.equations().bodies().stiffness(k));
      }
      else if (!turning.empty())
        step.equations().interface().update_moving();
      before = change;
    }
    return false;
  }
} // namespace taut
