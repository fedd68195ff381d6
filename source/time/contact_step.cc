// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/contact_step.h"
#include "base/least_number.h"
#include "time/matrix_norms.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace taut
{
  namespace
  {
    /// Part of its terms up to which the sum of some thousand loads is rounding.
    constexpr double rounding_of_loads = 1e-13;

    /// Part of the largest terms of a gap so far below which terms count as rest: motion that
    /// contacts stopped leaves rounding, which contradicts itself between constraints. Gaps are
    /// solved to 1e-12 of their terms: with this part, to 1e-15 of the largest ones, which is
    /// rounding.
    constexpr double part_of_largest = 1e-3;

    /// What the gap of a constraint rounds with. Gaps of surfaces are differences of coordinates
    /// that are far larger, but exact.
    double size_of_gap(const ConstraintData &constraint)
    {
      return std::fabs(constraint.gap) +
             (constraint.contact == no_contact ? constraint.gap_size : 0.);
    }
  } // namespace

  ContactStep::ContactStep(const Structure &structure, const Constraints &constraints,
                           const TurningConstraints &turning, const Reference &reference,
                           const StepMethod &method, const State &start)
      : structure(structure), constraints(constraints), turning(turning), reference(reference),
        method(method), laws(constraints), of_conditions(structure, constraints)
  {
    const std::size_t n = constraints.size();
    for (auto *v : {&solved.multiplier,
                    &balanced,
                    &impulses,
                    &problem.free_gap,
                    &problem.gap_scale,
                    &gap_correction,
                    &motion,
                    &motion_size,
                    &position,
                    &terms_size,
                    &scale_of_step,
                    &largest.gaps,
                    &largest.terms,
                    &velocity,
                    &velocity_size,
                    &rates_before,
                    &convection,
                    &rate_of_place,
                    &S,
                    &history})
      v->assign(n, 0.);
    problem.shared = constraints.shared();
    reference_gap = constraints.motions(reference.displacement);
    const std::vector<double> motions = constraints.motions(start.U);
    for (std::size_t i = 0; i < n; ++i)
    {
      problem.cones.push_back(constraints[i].cone);
      reference_gap[i] += constraints[i].gap;
      if (constraints.slides(i))
        gap_correction[i] = start.distance[i] - reference_gap[i] - motions[i];
      else if (!reference.gap.empty())
        reference_gap[i] = reference.gap[i];
    }
    add_body_terms(reference.displacement);
  }

  void ContactStep::prepare()
  {
    problem.null_space.clear();
    problem.null_space_load.clear();
    problem.null_space_terms.clear();
    problem.null_space_resistance.clear();
    solved.mode_amplitude.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      problem.cones[i] = constraints[i].cone;
      S[i] = constraints[i].spring.compliance(method.c.velocity);
    }
  }

  void ContactStep::set_problem(const State &before, const StepEquations &system,
                                const BodyVectors &P, const PrescribedMotions &prescribed)
  {
    if (system.has_modes())
    {
      system.set_modes(problem);
      system.set_mode_loads(P, problem);
    }
    // Loads that cancel leave their rounding, which no contact may be able to carry.
    for (std::size_t k = 0; k < problem.null_space_terms.size(); ++k)
      if (std::fabs(problem.null_space_load[k]) <= rounding_of_loads * problem.null_space_terms[k])
        problem.null_space_load[k] = 0.;
    if (constraints.n_of_all() == 0)
      return;
    predict_motions(before, system, P, prescribed.lift());
    if (method.has_means())
    {
      constraints.share_of_motions(before.V, velocity);
      constraints.sum({&velocity});
    }
    set_rates_of_prescribed(prescribed.lift_of_velocities());
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const double of_spring = begin_spring(i, before), gap = free_gap(i, before);
      problem.free_gap[i] = gap + motion[i] + of_spring;
      problem.gap_scale[i] = gap_scale(i, before, std::fabs(of_spring));
      if (constraints.slides(i))
        convection[i] = gap - before.distance[i];
      else if (constraints.turns(i))
        convection[i] = turning.reeled(i);
      if (method.rules[i].is_on_velocity())
        set_velocity_condition(i, before);
    }
  }

  /// Motions of the rows without multipliers, and the places of sliding ones.
  void ContactStep::predict_motions(const State &before, const StepEquations &system,
                                    const BodyVectors &P, const BodyVectors *const lift)
  {
    system.interface().contact_free_predictor(P, motion, motion_size);
    if (lift)
      for (std::size_t i = 0; i < constraints.size(); ++i)
        motion[i] += evaluate(constraints[i].terms, *lift);
    for (const std::size_t i : constraints.sliding_rows())
    {
      const std::vector<Term> &terms = constraints[i].terms;
      position[i] = evaluate(terms, reference.displacement) + evaluate(terms, before.U);
      terms_size[i] = magnitude(terms, reference.displacement) + magnitude(terms, before.U);
    }
    constraints.sum({&motion, &motion_size, &position, &terms_size});
  }

  double ContactStep::gap_of_place(const std::size_t i) const
  {
    return constraints[i].gap + gap_correction[i] + position[i];
  }

  /// Gap at the end of the step without the motion of the row.
  double ContactStep::free_gap(const std::size_t i, const State &before) const
  {
    if (constraints.slides(i))
      return gap_of_place(i);
    return constraints.turns(i) ? before.distance[i] + turning.offset(i) : before.distance[i];
  }

  /// Scale of the rounding of a gap in this step. @p other is the size of its terms that are not
  /// motions of the bodies.
  double ContactStep::gap_scale(const std::size_t i, const State &before, const double other)
  {
    double scale = constraints.slides(i) ? std::fabs(constraints[i].gap) + terms_size[i]
                                         : std::fabs(before.distance[i]);
    if (constraints.turns(i))
      scale += turning.distance(i);
    scale += motion_size[i];
    scale += std::fabs(motion[i]) + other;
    scale_of_step[i] = scale;
    return std::max(scale, part_of_largest * largest.gaps[i]);
  }

  void ContactStep::set_rates_of_prescribed(const BodyVectors *const lift)
  {
    of_prescribed.assign(lift ? constraints.size() : 0, 0.);
    if (!lift)
      return;
    constraints.share_of_motions(*lift, of_prescribed);
    constraints.sum(of_prescribed);
  }

  /// Sets (1 - alpha_f) step (D' + e D'_0) without multipliers.
  void ContactStep::set_velocity_condition(const std::size_t i, const State &before)
  {
    const double theta = 1. - method.c.alpha_f, step = method.length,
                 rebound = constraints[i].cone.restitution(method.c.restitution);
    problem.free_gap[i] = motion[i] - (1. - theta) * step * velocity[i] +
                          theta * (convection[i] + rebound * step * before.rate[i]);
    if (!of_prescribed.empty())
      problem.free_gap[i] += of_prescribed[i];
    if (!constraints[i].cone.may_open())
      return;
    const bool is_near = before.distance[i] + .5 * step * before.rate[i] <= 0.;
    problem.cones[i] = is_near || before.multiplier[i] > 0. ? constraints[i].cone : Cone::zero();
  }

  /// Begins a step of a spring. Returns h, or 0 with a law: find_multipliers() finds its h.
  double ContactStep::begin_spring(const std::size_t i, const State &before)
  {
    const ConstraintSpring &own = constraints[i].spring;
    const StepCoefficients &c = method.c;
    history[i] = 0.;
    if (!has_mean_spring(i) && !laws.has(i) && !(own.damping > 0.))
      return 0.;
    const RowStates::Spring &spring = before.springs[i];
    const double theta = 1. - c.alpha_f, step = method.length,
                 known = c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du;
    if (has_mean_spring(i) && own.conserving)
      laws.begin_conserving(i, spring.u > 0. ? spring.u : -before.distance[i],
                            2. * own.damping / step);
    else if (laws.has(i) && has_mean_spring(i))
      laws.begin_mean(i, spring.u, theta, own.damping / (theta * step));
    else if (laws.has(i) && c.is_at_rest())
      laws.begin_at_end(i, spring.u);
    else if (laws.has(i))
      laws.begin_at_end(i, spring.u, c.velocity * own.damping, spring.u - known / c.velocity);
    else if (has_mean_spring(i))
    {
      const double rate = own.damping / step;
      history[i] =
          -((1. - theta) * own.stiffness - rate) / (theta * own.stiffness + rate) * spring.u;
    }
    else
      history[i] = S[i] * own.damping * (c.velocity * spring.u - known);
    return history[i];
  }

  void ContactStep::find_multipliers(StepEquations &system, const StepCheck &check,
                                     Residuals &residuals, State &state)
  {
    const MixedComplementaritySolution &solution =
        laws.empty() ? system.find_multipliers(problem, check, residuals)
                     : laws.solve(problem, system, check, residuals, S, history);
    const std::vector<double> &L = solution.multiplier;
    solved.multiplier = balanced = state.multiplier = L;
    solved.mode_amplitude = solution.mode_amplitude;
    solved.closed = solution.closed;
    if (!method.has_means())
      return;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      impulses[i] = 0.;
      if (!method.rules[i].is_mean())
        continue;
      impulses[i] =
          L[i] + (constraints.slides(i) && method.rules[i].corrected ? previous_place[i] : 0.);
      balanced[i] = 0.;
      state.multiplier[i] = (1. - method.c.alpha_f) * L[i];
    }
  }

  const std::vector<double> &ContactStep::forces_at_previous_place(const State &before)
  {
    if (!method.corrects_velocities || constraints.sliding_rows().empty())
      return none;
    previous_place.assign(constraints.size(), 0.);
    for (const std::size_t i : constraints.sliding_rows())
      if (method.rules[i].corrected)
        previous_place[i] = -method.c.old_balance() * before.multiplier[i];
    return previous_place;
  }

  void ContactStep::update(State &state, StepReport &report)
  {
    measure_motions(state);
    report.impulse_work = 0.;
    report.work.assign(constraints.size(), 0.);
    if (method.has_means())
      measure_rates(state);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (method.rules[i].is_mean())
        report.work[i] = (1. - method.c.alpha_f) * impulses[i] * motion[i];
      largest.gaps[i] = std::max(largest.gaps[i], scale_of_step[i]);
      state.distance[i] =
          constraints.slides(i)
              ? gap_of_place(i)
              : state.distance[i] + (constraints.turns(i) ? turning.increment(i) : motion[i]);
      state.complementarity_gap[i] = end_spring(i, state);
    }
  }

  /// B^T dU and B^T U of the new state.
  void ContactStep::measure_motions(const State &state)
  {
    constraints.share_of_motions(state.dU, motion);
    constraints.share_of_motions(state.U, position, terms_size);
    for (const std::size_t i : constraints.sliding_rows())
      position[i] += evaluate(constraints[i].terms, reference.displacement);
    constraints.sum({&motion, &position, &terms_size});
  }

  void ContactStep::measure_velocities(const State &state)
  {
    constraints.share_of_motions(state.V, velocity, velocity_size);
    constraints.sum({&velocity, &velocity_size});
  }

  /// Rates of the state, and those before the step. Places of sliding rows count exactly if
  /// velocities are corrected.
  void ContactStep::measure_rates(State &state)
  {
    measure_velocities(state);
    const bool is_exact = method.corrects_velocities;
    if (is_exact && !constraints.sliding_rows().empty())
    {
      for (const std::size_t i : constraints.sliding_rows())
        rate_of_place[i] =
            constraints.share_of_convection(i, state.time, reference.displacement, state.U);
      constraints.sum({&rate_of_place});
      for (const std::size_t i : constraints.sliding_rows())
        rate_of_place[i] += constraints.profile_rate(i, state.time, method.length);
    }
    for (const std::size_t i : constraints.turning_rows())
      rate_of_place[i] = constraints.turning(i).reel_rate(state.time, method.length);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      rates_before[i] = state.rate[i];
      state.rate[i] = velocity[i] + (is_exact ? rate_of_place[i] : convection[i] / method.length);
    }
  }

  void ContactStep::update_rates(State &state)
  {
    measure_velocities(state);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      state.rate[i] = velocity[i] + rate_of_place[i];
  }

  /// Updates the spring in the state. Returns D, the gap including the spring.
  double ContactStep::end_spring(const std::size_t i, State &state) const
  {
    // Part of its scale below which a gap that is a small difference of motions has a more exact
    // value from its force: such a gap has lost four of sixteen digits, and forces are solved to
    // twelve.
    constexpr double small = 1e-4;
    const StepCoefficients &c = method.c;
    RowStates::Spring &spring = state.springs[i];
    const double N = solved.multiplier[i], gap = state.distance[i],
                 known_v = c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du,
                 known_a = c.a_V * spring.v + c.a_A * spring.a + c.a_dU * spring.du;
    double u = S[i] * N + history[i];
    if (has_mean_spring(i) && constraints[i].spring.conserving)
      u = std::max(0., !(N > 0.)                                   ? laws.relaxed(i, -gap)
                       : std::fabs(gap) > small * scale_of_step[i] ? -gap
                                                                   : laws.polished(i, -gap, N));
    else if (has_mean_spring(i))
      u = constraints[i].cone.project(u);
    if (std::fabs(u) < least_number)
      u = 0.;
    spring.du = u - spring.u;
    spring.u = u;
    spring.v = c.velocity * spring.du + known_v;
    spring.a = c.acceleration * spring.du + known_a;
    const double D = gap + spring.u;
    return constraints[i].spring.law && !has_mean_spring(i) ? D + laws.lack(i, u, N) : D;
  }

  bool ContactStep::remains_in_contact(const std::size_t i, const State &state) const
  {
    // Part of the distance of the ends, and of the terms of the rate, that is rounding: the change
    // of the increments at which Newton's method ends.
    constexpr double rounding = 1e-9;
    const bool is_inconsistent =
        is_first && std::fabs(rates_before[i]) > rounding * velocity_size[i];
    return !is_inconsistent && constraints.turns(i) && constraints[i].spring.is_rigid() &&
           state.distance[i] - turning.increment(i) <= rounding * turning.distance(i);
  }

  double ContactStep::drift(const State &state) const
  {
    double most = 0.;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (method.rules[i].is_on_velocity() && constraints[i].cone.is_free())
        most = std::max(most, std::fabs(state.distance[i]));
    return constraints.max(most);
  }

  bool ContactStep::correct(const State &state, StepEquations &system, const BodyVectors &left,
                            const BodyVectors &on_modes)
  {
    MixedComplementarityProblem remainder;
    remainder.cones = problem.cones;
    remainder.shared = problem.shared;
    system.interface().contact_free_predictor(left, remainder.free_gap, remainder.gap_scale);
    constraints.sum({&remainder.free_gap, &remainder.gap_scale});
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      remainder.free_gap[i] += state.complementarity_gap[i];
      remainder.gap_scale[i] += std::fabs(state.complementarity_gap[i]) + terms_size[i];
      if (constraints.slides(i))
        remainder.gap_scale[i] += std::fabs(constraints[i].gap);
    }
    if (!system.has_modes())
      return system.correct(remainder, solved, correction);
    system.set_mode_loads(on_modes, remainder);
    remainder.null_space_resistance = problem.null_space_resistance;
    remainder.null_space.swap(problem.null_space); // lent: it is large
    const bool is_found = system.correct(remainder, solved, correction);
    remainder.null_space.swap(problem.null_space);
    return is_found;
  }

  void ContactStep::add_correction(const BodyVectors &dU, State &state)
  {
    const std::vector<double> moved = constraints.motions(dU);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      for (double *const x : {&motion[i], &position[i], &state.distance[i]})
        *x += moved[i];
      const double dN = correction.multiplier[i], du = S[i] * dN;
      for (double *const N : {&solved.multiplier[i], &balanced[i], &state.multiplier[i]})
        *N += dN;
      RowStates::Spring &spring = state.springs[i];
      spring.u += du;
      spring.du += du;
      spring.v += method.c.velocity * du;
      spring.a += method.c.acceleration * du;
      state.complementarity_gap[i] = state.distance[i] + spring.u;
    }
    for (std::size_t k = 0; k < solved.mode_amplitude.size(); ++k)
      solved.mode_amplitude[k] += correction.mode_amplitude[k];
  }

  void ContactStep::restore(const MixedComplementaritySolution &earlier, const State &state)
  {
    solved = earlier;
    balanced = solved.multiplier;
    measure_motions(state);
  }

  /// Sets gaps from increments of the displacements, not from F N + d.
  void ContactStep::set_recomputed_gaps(const State &state)
  {
    recomputed.multiplier = solved.multiplier;
    recomputed.mode_amplitude = solved.mode_amplitude;
    recomputed.gap = state.complementarity_gap;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (has_mean_spring(i))
      {
        const double N = solved.multiplier[i], u = S[i] * N + history[i];
        recomputed.gap[i] = state.distance[i] + u + laws.lack(i, u, N);
      }
      else if (method.rules[i].is_on_velocity())
      {
        const double rebound =
            constraints[i].cone.restitution(method.c.restitution) * rates_before[i];
        recomputed.gap[i] = (1. - method.c.alpha_f) * method.length * (state.rate[i] + rebound);
      }
  }

  double ContactStep::residual(const State &state, StepEquations &system, std::size_t &worst)
  {
    if (constraints.n_of_all() == 0)
      return 0.;
    set_recomputed_gaps(state);
    const double max =
        of_conditions.measure(method.c, problem, recomputed, motion, S, state, system, worst);
    // Tracked gaps must not drift away from the displacements.
    std::size_t strayed = 0;
    const double drifted = largest_stray(state, strayed);
    if (drifted <= max || std::isnan(max))
      return max;
    worst = strayed;
    return drifted;
  }

  /// Largest difference between a tracked gap and the gap from displacements, over the terms of the
  /// gap, and its constraint.
  double ContactStep::largest_stray(const State &state, std::size_t &worst)
  {
    // At a support, a constraint moves only by the rounding of its body. That is looked at where
    // the difference is more than some thousand roundings of the terms.
    constexpr double suspicious = 1e-12;
    const double found = stray(state, worst);
    if (found <= suspicious)
      return found;
    add_body_terms(state.U);
    return stray(state, worst);
  }

  double ContactStep::stray(const State &state, std::size_t &worst)
  {
    double max = 0.;
    for (const std::size_t i : constraints.fixed_rows())
    {
      largest.terms[i] = std::max(largest.terms[i], std::fabs(reference_gap[i]) + terms_size[i]);
      const double error = std::fabs(reference_gap[i] + position[i] - state.distance[i]),
                   relative = error == 0. ? 0. : error / largest.terms[i];
      if (!(relative <= max) && !std::isnan(max))
      {
        max = relative;
        worst = i;
      }
    }
    return agreed(max, worst);
  }

  /// The largest number of all ranks, and its row where this rank has it.
  double ContactStep::agreed(const double own, std::size_t &worst) const
  {
    const double all = constraints.max(own);
    if (!(own >= all) && !std::isnan(own))
      worst = no_link;
    return all;
  }

  /// Sizes of the terms of B^T U, if a displacement rounds with the largest one of its body.
  std::vector<double> ContactStep::body_terms(const BodyVectors &U) const
  {
    std::vector<ByKind> size;
    for (std::size_t k = 0; k < structure.size(); ++k)
      size.push_back(max_norms(structure[k], U[k]));
    std::vector<double> terms(constraints.size(), 0.);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const auto &[k, form, of] : constraints[i].terms)
        for (std::size_t j = 0; j < form.index.size(); ++j)
          terms[i] += std::fabs(form.value[j]) * size[k][structure[k].kind(form.index[j])];
    constraints.sum(terms);
    return terms;
  }

  void ContactStep::add_body_terms(const BodyVectors &U)
  {
    const std::vector<double> terms = body_terms(U);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      largest.terms[i] = std::max(largest.terms[i], size_of_gap(constraints[i]) + terms[i]);
  }

  void ContactStep::count_motions(const BodyVectors &U)
  {
    const std::vector<double> terms = body_terms(U), moved = constraints.motions(U);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      largest.gaps[i] =
          std::max(largest.gaps[i], terms[i] + (size_of_gap(constraints[i]) + std::fabs(moved[i])) /
                                                   part_of_largest);
  }
} // namespace taut
