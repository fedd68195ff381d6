// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/constraint_motions.h>

namespace taut
{
  /// The part of the compression of a link's spring that does not depend on N.
  double ConstraintMotions::spring_history(const std::size_t i, const State &before) const
  {
    const ConstraintData &constraint = constraints[i];
    const State::LinkSpring &spring = before.link_springs[i];
    if (elastic_mean(i))
    {
      const double theta = 1. - c.alpha_f, rate = constraint.damping / step;
      return -((1. - theta) * constraint.stiffness - rate) / (theta * constraint.stiffness + rate) *
             spring.u;
    }
    if (!(constraint.damping > 0.))
      return 0.;
    const double known = c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du;
    return S[i] * constraint.damping * (c.velocity * spring.u - known);
  }

  /// The spring of a constraint with a law.
  void ConstraintMotions::begin_law(const std::size_t i, const State &before)
  {
    const double damping = constraints[i].damping, theta = 1. - c.alpha_f;
    const State::LinkSpring &spring = before.link_springs[i];
    if (conserves(i))
      laws.begin_conserving(i, spring.u > 0. ? spring.u : -before.geometric_gap[i],
                            2. * damping / step);
    else if (elastic_mean(i))
      laws.begin_mean(i, spring.u, theta, damping / (theta * step));
    else
      laws.begin_at_end(i, spring.u, c.velocity * damping,
                        spring.u - (c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du) /
                                       c.velocity);
  }

  void ConstraintMotions::find_multipliers(StepSystem &system, const StepCheck &check,
                                           Certificate &certificate, State &state)
  {
    set_multipliers(laws.empty()
                        ? system.find_multipliers(conditions, check, certificate)
                        : laws.solve(conditions, system, check, certificate, S, link_history),
                    state);
  }

  void ConstraintMotions::set_multipliers(const MixedComplementaritySolution &solution,
                                          State &state)
  {
    const std::vector<double> &L = solution.multiplier;
    solved.multiplier = balanced = state.multiplier = L;
    solved.mode_amplitude = solution.mode_amplitude;
    solved.closed = solution.closed;
    if (!c.mean_force)
      return;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      impulses[i] = 0.;
      if (!mean[i])
        continue;
      impulses[i] = L[i] + (constraints[i].moving && c.velocity_projection ? shifted[i] : 0.);
      balanced[i] = 0.;
      state.multiplier[i] = (1. - c.alpha_f) * L[i];
    }
  }

  const std::vector<double> &ConstraintMotions::old_place(const State &before)
  {
    if (!c.velocity_projection || constraints.first_moving() == constraints.size())
      return none;
    shifted.assign(constraints.size(), 0.);
    for (std::size_t i = constraints.first_moving(); i < constraints.size(); ++i)
      if (mean[i])
        shifted[i] = -c.old_balance() * before.multiplier[i];
    return shifted;
  }
} // namespace taut
