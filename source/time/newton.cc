// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/time/time_stepper.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut
{
  namespace
  {
    /// What a guess of the increments may miss, see NonlinearBodies::set_guess(). Where it stays
    /// above for rounding, the iteration ends below the second one after so many iterations that do
    /// not halve it; the balance of the step then says what it is worth.
    constexpr double converged = 1e-9, stagnated = 1e-5;
    constexpr int most_stagnant = 2;

    /// A tangent is kept while the rate at which changes fall promises no more iterations than
    /// this, and for the next step if this one took no more: a tangent and its factors cost as much
    /// as two or three, and spare some, but not all of those.
    constexpr int most_with_a_kept_tangent = 5;
    constexpr int most_iterations = 30;

    /// Whether a change that follows one @p before needs more, at the same rate.
    bool is_slow(const double change, const double before)
    {
      return !(change * std::pow(change / before, most_with_a_kept_tangent) <= converged);
    }
  } // namespace

  void TimeStepper::set_nonlinear()
  {
    if (!nonlinear.indices().empty())
      system->set_nonlinear(nonlinear.indices(), [this](const std::size_t k, const int attempt)
                            { return nonlinear.tangent(k, attempt); });
  }

  /// Tangents and F anew.
  void TimeStepper::linearise()
  {
    if (bodies_are_linear)
      system->interface().update_moving();
    else
      system->linearise();
  }

  /// Inertia has to resist the force of a constraint whatever its direction is.
  void TimeStepper::check_turning() const
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

  /// P^ of the step, which becomes the right-hand side.
  void TimeStepper::set_loads()
  {
    structure.communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < structure.size(); ++k)
            set_history(k);
        });
    if (const std::vector<double> &old = conditions.forces_at_previous_place(current); !old.empty())
      constraints.add_forces(old, right_hand_side);
  }

  /// The right-hand side becomes dU.
  void TimeStepper::find_increments()
  {
    conditions.set_problem(current, *system, right_hand_side, lift);
    if (constraints.size() > 0 || system->has_modes())
    {
      const Certificate before = last;
      conditions.find_multipliers(*system, check, last, current);
      last.iterations += before.iterations;
      last.fallback = last.fallback || before.fallback;
    }
    system->find_increments(conditions.applied().multiplier, conditions.applied().mode_amplitude,
                            right_hand_side);
  }

  /// The largest change of the increments of all ranks.
  double TimeStepper::set_guess()
  {
    double change = 0.;
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (structure[k].has_moving_constraints())
        for (const ConstrainedDof &constraint : structure[k].constraints())
          right_hand_side[k][constraint.dof] = lift[k][constraint.dof];
    structure.communicator().agree(
        [&]
        {
          for (const std::size_t k : nonlinear.indices())
          {
            const double own =
                nonlinear.set_guess(k, right_hand_side[k], system->bodies().stiffness(k));
            if (!(own <= change) && !std::isnan(change))
              change = own;
          }
        });
    return structure.communicator().max(std::isnan(change) ? std::numeric_limits<double>::infinity()
                                                           : change);
  }

  /**
   * Newton's method from dU = 0, with the tangent of a step before while it pays; a new one is that
   * of the last guess.
   */
  void TimeStepper::iterate()
  {
    if (solve_by_newton())
      return;
    if (tangents_are_kept)
    {
      tangents_are_kept = false;
      if (solve_by_newton())
        return;
    }
    throw UserError(to_text("at t = ", current.time,
                            " s: Newton's method does not converge in a step of ", step,
                            " s. Take a smaller step"));
  }

  bool TimeStepper::solve_by_newton()
  {
    const std::vector<double> multiplier = current.multiplier;
    nonlinear.begin(current, coefficients, step);
    turning.begin(coefficients);
    if (!tangents_are_kept)
      linearise();
    else if (!turning.empty())
      system->interface().update_moving();
    set_loads();
    const BodyVectors loads = right_hand_side;
    double before = std::numeric_limits<double>::infinity();
    int stagnant = 0;
    for (int iteration = 1; iteration <= most_iterations; ++iteration)
    {
      right_hand_side = loads;
      for (const std::size_t k : nonlinear.indices())
        for (std::size_t i = 0; i < right_hand_side[k].size(); ++i)
          right_hand_side[k][i] += nonlinear.remainder(k)[i];
      current.multiplier = multiplier;
      find_increments();
      ++n_iterations;
      const double change = std::max(
          set_guess(), turning.empty() ? 0.
                                       : turning.set_guess(right_hand_side, current,
                                                           conditions.applied().multiplier,
                                                           conditions.springs().histories()));
      stagnant = change >= .5 * before ? stagnant + 1 : 0;
      if (change <= converged || (change <= stagnated && stagnant == most_stagnant))
      {
        tangents_are_kept = iteration <= most_with_a_kept_tangent;
        return true;
      }
      if (std::isinf(change))
        return false;
      turning.turn();
      if (iteration > 1 && is_slow(change, before))
      {
        tangents_are_kept = false;
        linearise();
        for (const std::size_t k : nonlinear.indices())
          nonlinear.set_tangent(k, system->bodies().stiffness(k));
      }
      else if (!turning.empty())
        system->interface().update_moving();
      before = change;
    }
    return false;
  }
} // namespace taut
