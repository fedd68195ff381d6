// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/sum_together.h>
#include <taut/time/contact_conditions.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Part of its terms up to which the sum of some thousand loads is rounding.
    constexpr double rounding_of_loads = 1e-13;
  } // namespace

  ContactConditions::ContactConditions(const Structure &structure, const Constraints &constraints,
                                       const TurningConstraints &turning,
                                       const Reference &reference, const State &start)
      : structure(structure), constraints(constraints), turning(turning),
        gap_tracker(structure, constraints, turning, reference, start),
        gap_rates(structure, constraints, reference), link_springs(constraints),
        mean(constraints.size(), 0), quasi_static(constraints.quasi_static())
  {
    const std::size_t n = constraints.size();
    for (auto *v : {&solved.multiplier, &balanced, &impulses})
      v->assign(n, 0.);
    problem.free_gap.resize(n);
    problem.gap_scale.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      problem.cones.push_back(constraints[i].cone);
  }

  void ContactConditions::prepare(const StepCoefficients &coefficients, const double tau)
  {
    c = coefficients;
    step = tau;
    problem.null_space.clear();
    problem.null_space_load.clear();
    problem.null_space_terms.clear();
    problem.null_space_resistance.clear();
    solved.mode_amplitude.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      problem.cones[i] = constraints[i].cone;
      mean[i] =
          c.mean_force &&
          (constraints[i].spring.is_rigid() ||
           (c.velocity_projection && (constraints[i].cone.may_open() || constraints.turns(i)))) &&
          !(c.velocity_projection && quasi_static[i]);
    }
    gap_rates.prepare(c, step);
    link_springs.prepare(c, step, mean);
  }

  void ContactConditions::set_problem(const State &before, const StepEquations &system,
                                      const BodyVectors &P, const PrescribedMotions &prescribed)
  {
    if (system.has_modes())
      system.set_modes(P, problem);
    // Loads that cancel leave their rounding, which no contact may be able to carry.
    for (std::size_t k = 0; k < problem.null_space_terms.size(); ++k)
      if (std::fabs(problem.null_space_load[k]) <= rounding_of_loads * problem.null_space_terms[k])
        problem.null_space_load[k] = 0.;
    if (constraints.size() == 0)
      return;
    gap_tracker.predict(before, system, P, prescribed.lift());
    if (c.mean_force)
      gap_rates.begin(before);
    set_rates_of_prescribed(prescribed.lift_of_velocities());
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const double history = link_springs.begin(i, before), gap = gap_tracker.free_gap(i, before);
      problem.free_gap[i] = gap + gap_tracker.increments()[i] + history;
      problem.gap_scale[i] = gap_tracker.set_scale(i, before, std::fabs(history));
      if (constraints.slides(i))
        gap_rates.set_convection(i, gap - before.geometric_gap[i]);
      if (on_velocities(i))
        set_velocity_condition(i, before);
    }
  }

  void ContactConditions::set_rates_of_prescribed(const BodyVectors *const lift)
  {
    of_prescribed.assign(lift ? constraints.size() : 0, 0.);
    if (!lift)
      return;
    constraints.share_of_motions(*lift, of_prescribed);
    structure.communicator().sum(of_prescribed);
  }

  /// Sets (1 - alpha_f) step (D' + e D'_0) without multipliers.
  void ContactConditions::set_velocity_condition(const std::size_t i, const State &before)
  {
    const double theta = 1. - c.alpha_f, rebound = constraints[i].cone.restitution(c.restitution);
    problem.free_gap[i] =
        gap_tracker.increments()[i] - (1. - theta) * step * gap_rates.velocities()[i] +
        theta * (gap_rates.of_convection(i) + rebound * step * before.gap_rate[i]);
    if (!of_prescribed.empty())
      problem.free_gap[i] += of_prescribed[i];
    if (!constraints[i].cone.may_open())
      return;
    const bool is_near = before.geometric_gap[i] + .5 * step * before.gap_rate[i] <= 0.;
    problem.cones[i] = is_near || before.multiplier[i] > 0. ? constraints[i].cone : Cone::zero();
  }

  void ContactConditions::find_multipliers(StepEquations &system, const StepCheck &check,
                                           Certificate &certificate, State &state)
  {
    const MixedComplementaritySolution &solution =
        link_springs.solve(problem, system, check, certificate);
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
      impulses[i] =
          L[i] + (constraints.slides(i) && c.velocity_projection ? previous_place[i] : 0.);
      balanced[i] = 0.;
      state.multiplier[i] = (1. - c.alpha_f) * L[i];
    }
  }

  const std::vector<double> &ContactConditions::forces_at_previous_place(const State &before)
  {
    if (!c.velocity_projection || constraints.sliding_rows().empty())
      return none;
    previous_place.assign(constraints.size(), 0.);
    for (const std::size_t i : constraints.sliding_rows())
      if (mean[i])
        previous_place[i] = -c.old_balance() * before.multiplier[i];
    return previous_place;
  }

  void ContactConditions::update(State &state)
  {
    gap_tracker.measure(state);
    if (c.mean_force)
    {
      gap_rates.accept(state);
      state.is_mean = mean;
      state.constraint_work.assign(constraints.size(), 0.);
      state.impulse_work = 0.;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if (mean[i])
          state.constraint_work[i] = (1. - c.alpha_f) * impulses[i] * gap_tracker.increments()[i];
    }
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      state.geometric_gap[i] = gap_tracker.new_gap(i, state);
      state.gap[i] = link_springs.accept(i, state.geometric_gap[i], solved.multiplier[i],
                                         gap_tracker.scale(i), state);
    }
  }

  bool ContactConditions::remains_in_contact(const std::size_t i, const State &state) const
  {
    // Part of the distance of the ends, and of the terms of the rate, that is rounding.
    constexpr double rounding = 1e-9;
    const bool is_inconsistent = is_first && std::fabs(gap_rates.before_step()[i]) >
                                                 rounding * gap_rates.velocity_sizes()[i];
    return !is_inconsistent && constraints.turns(i) && constraints[i].spring.is_rigid() &&
           state.geometric_gap[i] - turning.increment(i) <= rounding * turning.distance(i);
  }

  double ContactConditions::drift(const State &state) const
  {
    double largest = 0.;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (on_velocities(i) && constraints[i].cone.is_free())
        largest = std::max(largest, std::fabs(state.geometric_gap[i]));
    return largest;
  }

  bool ContactConditions::correct(const State &state, StepEquations &system,
                                  const BodyVectors &left, const BodyVectors &on_modes)
  {
    MixedComplementarityProblem remainder;
    remainder.cones = problem.cones;
    system.interface().contact_free_predictor(left, remainder.free_gap, remainder.gap_scale);
    sum_together(structure.communicator(), {&remainder.free_gap, &remainder.gap_scale});
    if (system.has_modes())
      system.set_modes(on_modes, remainder);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      remainder.free_gap[i] += state.gap[i];
      remainder.gap_scale[i] += std::fabs(state.gap[i]) + gap_tracker.term_sizes()[i];
      if (constraints.slides(i))
        remainder.gap_scale[i] += std::fabs(constraints[i].gap);
    }
    return system.correct(remainder, solved, correction);
  }

  void ContactConditions::add_correction(const BodyVectors &dU, State &state)
  {
    gap_tracker.correct(dU, state);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const double dN = correction.multiplier[i];
      for (double *const N : {&solved.multiplier[i], &balanced[i], &state.multiplier[i]})
        *N += dN;
      link_springs.correct(i, dN, state);
    }
    for (std::size_t k = 0; k < solved.mode_amplitude.size(); ++k)
      solved.mode_amplitude[k] += correction.mode_amplitude[k];
  }

  void ContactConditions::restore(const MixedComplementaritySolution &earlier, const State &state)
  {
    solved = earlier;
    balanced = solved.multiplier;
    gap_tracker.measure(state);
  }
} // namespace taut
