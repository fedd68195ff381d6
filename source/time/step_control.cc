// SPDX-License-Identifier: LGPL-2.1-or-later

#include "time/step_control.h"
#include <taut/base/exceptions.h>
#include <taut/substructure/body_traits.h>
#include <taut/time/motion.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace taut
{
  namespace
  {
    /// Largest number of halvings of a step without convergence of Newton's method: what does not
    /// converge with a 256th of the step is no matter of the step. For a contact with a damper: a
    /// millionth, as its step is known from its stiffness and mass.
    constexpr unsigned int most_halvings = 8, most_for_contacts = 20;

    /// Number of steps with this part of the tolerance after which the length doubles: twice the
    /// step has 2^3 = 8 times the error of smooth motions, 0.8 of the tolerance. Two, as the error
    /// of one step may pass through zero.
    constexpr unsigned int most_calm = 2;
    constexpr double calm = .1;

    /// Order of the local error of smooth motions in the step.
    constexpr double order_of_error = 3.;

    unsigned int halvings(const Constraints &constraints, const StepParameters &parameters,
                          const double step, const bool may_halve,
                          const std::vector<LongestStep> &longest_steps)
    {
      unsigned int n = parameters.adaptive() ? parameters.n_halvings
                       : may_halve           ? most_halvings
                                             : 0;
      for (const LongestStep &longest : longest_steps)
        if (const double shortest = longest.shortest(); shortest < step)
          n = std::max(n, std::min(most_for_contacts, static_cast<unsigned int>(
                                                          std::ceil(std::log2(step / shortest)))));
      return static_cast<unsigned int>(constraints.max(n));
    }
  } // namespace

  void StepParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Step control", control,
                      "'fixed': all steps have the length Step. 'adaptive': Step times powers of "
                      "two, by the local error; impacts and jumps of loads are met by short steps",
                      Selection("fixed|adaptive"));
    prm.add_parameter(
        "Step in damped contacts", in_damped_contacts,
        "In contacts of links with dampers Step is halved until it keeps the rebound "
        "within a percent: they take steps so many times as long as that asks for [1]",
        Double(1e-6, 1e3));
    prm.enter_subsection("Adaptive step");
    prm.add_parameter("Tolerance", tolerance,
                      "Largest local error of a step over the largest displacement so far [1]",
                      Double(1e-14, 1.));
    prm.add_parameter("Halvings", n_halvings,
                      "The shortest step is Step over two to this power: so exactly impacts are "
                      "met that the tolerance asks for more of [1]",
                      Integer(0, 40));
    prm.add_parameter("Doublings", n_doublings,
                      "The longest step is Step times two to this power [1]", Integer(0, 20));
    prm.add_parameter(
        "Largest step", largest,
        "The longest step is at most this; 0: by Doublings. "
        "Jumps and pulses of loads, given motions and heights are met by shorter ones [s]",
        Double(0., 1e9));
    prm.leave_subsection();
  }

  unsigned int StepParameters::most_doublings(const double step) const
  {
    unsigned int n = n_doublings;
    while (n > 0 && largest > 0. && std::ldexp(step, static_cast<int>(n)) > largest)
      --n;
    return n;
  }

  StepControl::StepControl(const Constraints &constraints, const StepParameters &parameters,
                           const double step, const long n_steps, const bool may_halve,
                           std::vector<LongestStep> longest)
      : constraints(constraints), parameters(parameters), longest_steps(std::move(longest)),
        some_longest_steps(constraints.any(!longest_steps.empty())),
        n_levels(halvings(constraints, parameters, step, may_halve, longest_steps)), step(step),
        shortest(std::ldexp(step, -static_cast<int>(n_levels))),
        end(std::min(n_steps, std::numeric_limits<long>::max() >> n_levels) << n_levels),
        level(n_levels), last_open(longest_steps.size(), -std::numeric_limits<double>::infinity())
  {
  }

  /// Makes a step of the present length, or a shorter one if it has no solution.
  void StepControl::solve(Motion &motion)
  {
    for (;;)
    {
      try
      {
        motion.try_step(shortest * length());
        return;
      }
      catch (const StepNotSolved &)
      {
        if (level == 0)
          throw;
      }
      shorten(1);
    }
  }

  void StepControl::shorten(const unsigned int n_levels_down)
  {
    level -= std::min(level, n_levels_down);
    ++repeated;
    n_calm = 0;
  }

  /// Longest step that resolves a contact in the last step [s].
  double StepControl::longest_step(const std::size_t i, const Motion &motion) const
  {
    return longest_steps[i].between(-motion.rows_before().distance[i], -motion.state().distance[i]);
  }

  /// Whether a contact is under way: it opens or closes, may still be a rebound, or its force
  /// changes much. Others follow their bodies.
  bool StepControl::is_moving_contact(const std::size_t i, const Motion &motion) const
  {
    // Longest steps that a rebound takes, and the part of its force that a step may change. The
    // time of a contact without its damper has 16 + 32 zeta of them, see LongestStep: 38 at the
    // part zeta = 0.7 of the critical damping, from which on nothing rebounds.
    constexpr double steps_of_rebound = 40., large_change = .2;
    const double first = motion.rows_before().multiplier[i], last = motion.state().multiplier[i];
    if (!(first > 0.) || !(last > 0.))
      return first > 0. || last > 0.;
    return motion.state().time - last_open[i] <
               steps_of_rebound * longest_step(i, motion) / longest_steps[i].factor ||
           !(std::fabs(last - first) <= large_change * std::max(first, last));
  }

  /// A contact under way may need shorter steps than the last one.
  bool StepControl::is_too_long_for_contacts(const Motion &motion) const
  {
    constexpr double rounding = 1e-9; // of a power of two times Step, and of formulas of dampers
    if (!some_longest_steps)
      return false;
    bool is_too_long = false;
    for (std::size_t i = 0; i < longest_steps.size() && !is_too_long; ++i)
      is_too_long = shortest * length() > longest_step(i, motion) * (1. + rounding) &&
                    is_moving_contact(i, motion);
    return constraints.any(is_too_long);
  }

  /// Whether a contact under way that may need shorter steps than Step is closed.
  bool StepControl::is_in_short_contact(const Motion &motion) const
  {
    if (!some_longest_steps)
      return false;
    bool is_closed = false;
    for (std::size_t i = 0; i < longest_steps.size() && !is_closed; ++i)
      is_closed = longest_steps[i].shortest() < step && motion.state().multiplier[i] > 0. &&
                  is_moving_contact(i, motion);
    return constraints.any(is_closed);
  }

  void StepControl::advance_fixed(Motion &motion)
  {
    if (n_levels == 0)
    {
      motion.try_step(step);
      ++position;
      return;
    }
    solve(motion);
    while (level > 0 && is_too_long_for_contacts(motion))
    {
      motion.take_back();
      shorten(1);
      solve(motion);
    }
    position += length();
    if (level == n_levels || is_in_short_contact(motion))
      return;
    while (level < n_levels && position % (2 * length()) == 0)
      ++level;
  }

  void StepControl::advance_adaptive(Motion &motion)
  {
    const bool is_first = position == 0;
    while (position + length() > end)
      --level;
    double error = 0.;
    for (;;)
    {
      while (level > 0 && !motion.resolves_loads(shortest * length(), parameters.tolerance))
        --level;
      solve(motion);
      error = motion.local_error() / parameters.tolerance;
      if (level == 0 || (!(error > 1.) && !is_too_long_for_contacts(motion)))
        break;
      const double too_long = std::isfinite(error) ? std::log2(std::max(error, 1.)) : 0.;
      motion.take_back();
      shorten(std::max(1u, static_cast<unsigned int>(too_long / order_of_error)));
    }
    position += length();
    n_calm = error < calm && !is_first ? n_calm + 1 : 0;
    if (n_calm >= most_calm && level < n_levels + parameters.most_doublings(step) &&
        position % (2 * length()) == 0)
    {
      ++level;
      n_calm = 0;
    }
  }

  void StepControl::advance(Motion &motion)
  {
    const unsigned int level_before = level, n_calm_before = n_calm;
    const long repeated_before = repeated;
    try
    {
      if (parameters.adaptive())
        advance_adaptive(motion);
      else
        advance_fixed(motion);
    }
    catch (...)
    {
      level = level_before;
      n_calm = n_calm_before;
      repeated = repeated_before;
      throw;
    }
    const State &state = motion.state();
    for (std::size_t i = 0; i < last_open.size(); ++i)
      if (!(state.multiplier[i] > 0.))
        last_open[i] = state.time;
  }

  LocalError::LocalError(const Structure &structure, const Constraints &constraints,
                         const Reference &reference)
      : structure(structure), reference(reference),
        wholes(structure, constraints,
               [&](const std::size_t i) { return constraints[i].is_cut(); }),
        mass_of_whole(wholes.n_groups(), 0.)
  {
    const std::vector<double> of_bodies = total_masses(structure);
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (!structure[k].is_lumped())
        mass_of_whole[wholes.of_body(k)] += of_bodies[k];
    structure.communicator().sum(mass_of_whole);
  }

  /// Sets the error of the motion of a body in a step, and the further change of velocities by
  /// impulses times the step.
  void LocalError::set_error(const OfStep &of, const std::size_t k)
  {
    const std::vector<double> &dU = of.state.dU[k], &V = of.state.V[k], &V0 = of.state.V_old[k],
                              &A = of.state.A[k], &A0 = of.old_A[k];
    const double step = of.state.last_step,
                 mean = step * step / (6. * (1. + of.step_before / step));
    motion.resize(dU.size());
    impulse.resize(dU.size());
    for (std::size_t i = 0; i < dU.size(); ++i)
    {
      motion[i] = of.method.has_means() ? mean * (A[i] - A0[i])
                                        : dU[i] - step * (V0[i] + step * (A0[i] / 3. + A[i] / 6.));
      impulse[i] = of.method.corrects_velocities ? step * (V[i] - V0[i] - step * A[i]) : 0.;
    }
    // A prescribed place has no error, but its kinks and jumps need short steps.
    for (const ConstrainedDof &constraint : structure[k].constraints())
    {
      const unsigned int i = constraint.dof;
      motion[i] = dU[i] - .5 * step * (V0[i] + V[i]);
      impulse[i] = 0.;
    }
  }

  /// Multipliers of internal constraints are no motions, and may be rounding.
  ByKind LocalError::largest_of(const std::size_t k, std::vector<double> &x) const
  {
    if (dynamic_cast<const ConstrainedBody *>(&structure[k]))
      for (const unsigned int dof : structure[k].dofs_without_mass())
        x[dof] = 0.;
    return max_norms(structure[k], x);
  }

  double LocalError::measure(const State &state, const StepMethod &method, const double step_before,
                             const BodyVectors &old_A)
  {
    ByKind error = {0., 0.}, size = {0., 0.};
    std::array<std::vector<double>, 2> squares; // errors of elements: motions and impulses
    for (std::vector<double> &of_wholes : squares)
      of_wholes.assign(wholes.n_groups(), 0.);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      set_error({state, method, step_before, old_A}, k);
      const std::size_t whole = wholes.of_body(k);
      if (!structure[k].is_lumped() && mass_of_whole[whole] > 0.)
      {
        squares[0][whole] += square(k, motion);
        squares[1][whole] += square(k, impulse);
      }
      else
        for (std::vector<double> *const e : {&motion, &impulse})
        {
          const ByKind all = largest_of(k, *e);
          for (int kind = 0; kind < 2; ++kind)
            error[kind] = std::max(error[kind], all[kind]);
        }
      motion = state.V_old[k];
      const ByKind v = largest_of(k, motion);
      copy_displacement(reference, state, k, motion);
      const ByKind u = largest_of(k, motion);
      for (int kind = 0; kind < 2; ++kind)
        size[kind] = std::max(size[kind], u[kind] + state.last_step * v[kind]);
    }
    for (std::vector<double> &of_wholes : squares)
    {
      structure.communicator().sum(of_wholes);
      for (std::size_t w = 0; w < of_wholes.size(); ++w)
        if (of_wholes[w] > 0.)
          error[0] = std::max(error[0], std::sqrt(of_wholes[w] / mass_of_whole[w]));
    }
    double result = 0.;
    for (int kind = 0; kind < 2; ++kind)
    {
      largest_motions[kind] =
          std::max(largest_motions[kind], structure.communicator().max(size[kind]));
      const double all = structure.communicator().max(error[kind]);
      if (all > 0.)
        result = std::max(result, all / largest_motions[kind]);
    }
    return result;
  }

  double LocalError::square(const std::size_t k, const std::vector<double> &x)
  {
    product.assign(structure[k].n_dofs(), 0.);
    structure[k].mass().vmult_add(1., x.data(), product.data());
    return std::inner_product(product.begin(), product.end(), x.begin(), 0.);
  }
} // namespace taut
