// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/constraint_motions.h>
#include <taut/time/matrix_norms.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Part of the largest terms of a gap so far below which smaller ones count as rest: motion
    /// that contacts have stopped leaves rounding, and that of several constraints contradicts
    /// itself.
    constexpr double rest = 1e-3;
  } // namespace

  ConstraintMotions::ConstraintMotions(const Structure &structure, const Constraints &constraints,
                                       const TurningConstraints &turning,
                                       const Reference &reference, const State &start)
      : structure(structure), constraints(constraints), turning(turning), reference(reference),
        laws(constraints)
  {
    const std::size_t n = constraints.size();
    for (auto *v :
         {&S, &solved.multiplier, &balanced, &impulses, &link_history, &gap_terms, &gap_correction,
          &motion, &position, &terms_size, &velocity, &velocity_size, &rate_of_place, &motion_size,
          &convection, &rates_before, &scale_of_step, &largest_scale})
      v->assign(n, 0.);
    conditions.unilateral.resize(n);
    conditions.free_gap.resize(n);
    conditions.gap_scale.resize(n);
    reference_gap = constraints.motions(reference.displacement);
    const std::vector<double> motions = constraints.motions(start.U);
    for (std::size_t i = 0; i < n; ++i)
    {
      conditions.unilateral[i] = constraints[i].unilateral;
      reference_gap[i] += constraints[i].gap;
      if (constraints[i].moving)
        gap_correction[i] = start.geometric_gap[i] - reference_gap[i] - motions[i];
      else if (!reference.gap.empty())
        reference_gap[i] = reference.gap[i];
    }
    mean.assign(n, 0);
    quasi_static = constraints.quasi_static();
    add_body_terms(reference.displacement);
    for (std::size_t k = 0; k < structure.size(); ++k)
      supports_move = supports_move || structure[k].has_moving_constraints();
  }

  void ConstraintMotions::prepare(const StepCoefficients &coefficients, const double tau)
  {
    c = coefficients;
    step = tau;
    conditions.null_space.clear();
    conditions.null_space_load.clear();
    conditions.null_space_resistance.clear();
    solved.mode_amplitude.clear();
    conditions.held_open.assign(c.velocity_level ? constraints.size() : 0, 0);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      S[i] = 1. / (constraints[i].stiffness + c.velocity * constraints[i].damping);
      mean[i] = c.mean_force &&
                (S[i] == 0. || (c.velocity_projection &&
                                (constraints[i].unilateral || constraints[i].direction))) &&
                !(c.velocity_projection && quasi_static[i]);
    }
  }

  void ConstraintMotions::set_problem(const State &before, const StepSystem &system,
                                      const BodyVectors &P, const BodyVectors &lift)
  {
    if (system.has_modes())
      system.set_modes(P, conditions);
    if (constraints.size() == 0)
      return;
    share_contact_free_predictor(before, system, P, lift);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const ConstraintData &constraint = constraints[i];
      // Kelvin-Voigt: N = k u + c u' with u' = velocity du + known.
      const bool has_law = laws.has(i);
      if (has_law)
        begin_law(i, before);
      link_history[i] = has_law ? 0. : spring_history(i, before);

      double gap = before.geometric_gap[i], scale = std::fabs(gap);
      if (constraint.moving)
      {
        gap = moving_gap(i);
        scale = std::fabs(constraint.gap) + terms_size[i];
      }
      if (constraint.direction)
      {
        gap += turning.offset(i);
        scale += turning.distance(i);
      }
      scale += motion_size[i];
      conditions.free_gap[i] = gap + motion[i] + link_history[i];
      scale += std::fabs(motion[i]) + std::fabs(link_history[i]);
      scale_of_step[i] = scale;
      conditions.gap_scale[i] = std::max(scale, rest * largest_scale[i]);
      convection[i] = constraint.moving ? gap - before.geometric_gap[i] : 0.;
      if (velocity_level(i))
        set_velocity_condition(i, before);
    }
  }

  /// (1 - alpha_f) step (D' + e D'_0) without multipliers.
  void ConstraintMotions::set_velocity_condition(const std::size_t i, const State &before)
  {
    const double theta = 1. - c.alpha_f, rebound = constraints[i].unilateral ? c.restitution : 0.;
    conditions.free_gap[i] = motion[i] - (1. - theta) * step * velocity[i] +
                             theta * (convection[i] + rebound * step * before.gap_rate[i]);
    if (!constraints[i].unilateral)
      return;
    const bool is_near = before.geometric_gap[i] + .5 * step * before.gap_rate[i] <= 0.;
    conditions.held_open[i] = !is_near && !(before.multiplier[i] > 0.);
  }

  /// Of a conserving constraint. What is a small part of the motions that it is a difference of,
  /// its force tells better.
  double ConstraintMotions::compression(const std::size_t i, const double gap) const
  {
    constexpr double small = 1e-4;
    return std::fabs(gap) > small * scale_of_step[i] || !(solved.multiplier[i] > 0.)
               ? -gap
               : laws.polished(i, -gap, solved.multiplier[i]);
  }

  double ConstraintMotions::moving_gap(const std::size_t i) const
  {
    return constraints[i].gap + gap_correction[i] + position[i];
  }

  /// Before the contact forces are known: how the constraints would move without them, where the
  /// moving ones are, and what these numbers round with.
  void ConstraintMotions::share_contact_free_predictor(const State &before,
                                                       const StepSystem &system,
                                                       const BodyVectors &P,
                                                       const BodyVectors &lift)
  {
    system.interface().contact_free_predictor(P, motion, motion_size);
    if (supports_move)
      for (std::size_t i = 0; i < constraints.size(); ++i)
        motion[i] += evaluate(constraints[i].terms, lift);
    for (std::size_t i = constraints.first_moving(); i < constraints.size(); ++i)
    {
      const std::vector<Term> &terms = constraints[i].terms;
      position[i] = evaluate(terms, reference.displacement) + evaluate(terms, before.U);
      terms_size[i] = magnitude(terms, reference.displacement) + magnitude(terms, before.U);
    }
    if (c.mean_force)
      constraints.share_of_motions(before.V, velocity);
    share({&motion, &motion_size, &position, &terms_size});
    if (c.mean_force)
      share({&velocity});
  }

  /// After the step: increment of the constraints, and their motion since the reference.
  void ConstraintMotions::share_motions(const State &state)
  {
    constraints.share_of_motions(state.dU, motion);
    constraints.share_of_motions(state.U, position, terms_size);
    for (std::size_t i = constraints.first_moving(); i < constraints.size(); ++i)
      position[i] += evaluate(constraints[i].terms, reference.displacement);
    share({&motion, &position, &terms_size});
    if (c.mean_force)
    {
      constraints.share_of_motions(state.V, velocity, velocity_size);
      share({&velocity, &velocity_size});
    }
  }

  /// D' of the moving constraints besides B^T V, with their places exact.
  void ConstraintMotions::share_convection(const State &state)
  {
    for (std::size_t i = constraints.first_moving(); i < constraints.size(); ++i)
      rate_of_place[i] =
          constraints.share_of_convection(i, state.time, reference.displacement, state.U);
    if (constraints.first_moving() < constraints.size())
      share({&rate_of_place});
    for (std::size_t i = constraints.first_moving(); i < constraints.size(); ++i)
      rate_of_place[i] += constraints.profile_rate(i, state.time, step);
  }

  void ConstraintMotions::update_rates(State &state)
  {
    constraints.share_of_motions(state.V, velocity, velocity_size);
    share({&velocity, &velocity_size});
    for (std::size_t i = 0; i < constraints.size(); ++i)
      state.gap_rate[i] = velocity[i] + rate_of_place[i];
  }

  /// Sums vectors over the constraints, each with the shares of the bodies of this rank, over all
  /// ranks.
  void ConstraintMotions::share(const std::initializer_list<std::vector<double> *> vectors)
  {
    const Communicator &processes = structure.communicator();
    if (processes.size() == 1)
      return;
    work.clear();
    for (const std::vector<double> *v : vectors)
      work.insert(work.end(), v->begin(), v->end());
    processes.sum(work);
    const double *sums = work.data();
    for (std::vector<double> *v : vectors)
    {
      std::copy(sums, sums + v->size(), v->begin());
      sums += v->size();
    }
  }

  void ConstraintMotions::update(State &state)
  {
    share_motions(state);
    if (c.velocity_projection)
      share_convection(state);
    if (c.mean_force)
    {
      state.is_mean = mean;
      state.constraint_work.assign(constraints.size(), 0.);
      state.impulse_work = 0.;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if (mean[i])
          state.constraint_work[i] = (1. - c.alpha_f) * impulses[i] * motion[i];
    }
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      largest_scale[i] = std::max(largest_scale[i], scale_of_step[i]);
      double &gap = state.geometric_gap[i];
      if (constraints[i].moving)
        gap = moving_gap(i);
      else if (constraints[i].direction)
        gap += turning.increment(i);
      else
        gap += motion[i];

      State::LinkSpring &spring = state.link_springs[i];
      const double known_v = c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du;
      const double known_a = c.a_V * spring.v + c.a_A * spring.a + c.a_dU * spring.du;
      const double own = elastic_mean(i) ? solved.multiplier[i] : balanced[i],
                   free_u = S[i] * own + link_history[i],
                   u = conserves(i) ? std::max(0., compression(i, gap))
                       : elastic_mean(i) && constraints[i].unilateral ? std::max(0., free_u)
                                                                      : free_u;
      spring.du = u - spring.u;
      spring.u = u;
      spring.v = c.velocity * spring.du + known_v;
      spring.a = c.acceleration * spring.du + known_a;
      state.gap[i] = gap + spring.u;
      if (constraints[i].law && !elastic_mean(i))
        state.gap[i] += laws.lack(i, u, balanced[i]);
      if (c.mean_force)
      {
        rates_before[i] = state.gap_rate[i];
        state.gap_rate[i] =
            velocity[i] + (c.velocity_projection ? rate_of_place[i] : convection[i] / step);
      }
    }
  }

  double ConstraintMotions::residual(const State &state, const ComplementarityOperator &F,
                                     std::size_t &worst)
  {
    if (constraints.size() == 0)
      return 0.;
    // Gaps from the increments of the displacements, not from F N + d; and gaps so carried must not
    // drift away from the displacements, measured by the terms that these are summed from.
    recomputed.multiplier = solved.multiplier;
    recomputed.mode_amplitude = solved.mode_amplitude;
    recomputed.gap = state.gap;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (elastic_mean(i))
      {
        const double u = S[i] * solved.multiplier[i] + link_history[i];
        recomputed.gap[i] = state.geometric_gap[i] + u;
        if (laws.has(i))
          recomputed.gap[i] += laws.lack(i, u, solved.multiplier[i]);
      }
      else if (velocity_level(i))
      {
        const double rebound = constraints[i].unilateral ? c.restitution * rates_before[i] : 0.;
        recomputed.gap[i] = (1. - c.alpha_f) * step * (state.gap_rate[i] + rebound);
      }
    // Columns of A^-1 end where they have decayed to 1e-18: what moves less than that, beside the
    // constraints that move most, is not known by its own terms.
    constexpr double decayed = 1e-6;
    PerKind most = {0., 0.};
    for (std::size_t i = 0; i < constraints.size(); ++i)
      most[constraints[i].rotational] =
          std::max(most[constraints[i].rotational],
                   std::fabs(motion[i]) + F.diagonal(i) * std::fabs(solved.multiplier[i]));
    for (std::size_t i = 0; i < constraints.size(); ++i)
      conditions.gap_scale[i] += decayed * most[constraints[i].rotational];
    const auto measure = [&]
    {
      taut::gap_terms(conditions, F, solved.multiplier, recomputed.mode_amplitude, work);
      multiplier_weights(conditions, F, solved.multiplier, work, weights);
      taut::residual(conditions, recomputed, work, weights, found);
    };
    measure();
    constexpr double conspicuous = 1e-10;
    if (!(found.max <= conspicuous))
    {
      add_inertial_terms(state, F);
      measure();
    }
    double max = found.max;
    worst = std::max_element(found.rows.begin(), found.rows.end()) - found.rows.begin();
    // A constraint at a support moves by nothing but the rounding of its body.
    constexpr double suspicious = 1e-12;
    std::size_t strayed = 0;
    double stray = largest_stray(state, strayed);
    if (!(stray <= suspicious))
    {
      add_body_terms(state.U);
      stray = largest_stray(state, strayed);
    }
    if (!(stray <= max) && !std::isnan(max))
    {
      max = stray;
      worst = strayed;
    }
    return max;
  }

  /// A constraint rounds with the motion of the bodies as a whole, too: the slopes of a beam that
  /// falls without bending are nothing but rounding. |b . dU|^2 <= (b . A^-1 b) (dU . A dU).
  void ConstraintMotions::add_inertial_terms(const State &state, const ComplementarityOperator &F)
  {
    double sum = 0.;
    std::vector<double> product;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      product.assign(state.dU[k].size(), 0.);
      structure[k].mass().vmult_add(c.mass_factor(), state.dU[k].data(), product.data());
      for (std::size_t i = 0; i < product.size(); ++i)
        sum += state.dU[k][i] * product[i];
    }
    structure.communicator().sum(&sum, 1);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      conditions.gap_scale[i] += rest * std::sqrt(std::max(0., sum * (F.diagonal(i) - S[i])));
  }

  /// Largest distance of a carried gap from that of the displacements, over the terms of the gap.
  double ConstraintMotions::largest_stray(const State &state, std::size_t &worst)
  {
    double max = 0.;
    for (std::size_t i = 0; i < constraints.n_fixed(); ++i)
    {
      gap_terms[i] = std::max(gap_terms[i], std::fabs(reference_gap[i]) + terms_size[i]);
      const double error = std::fabs(reference_gap[i] + position[i] - state.geometric_gap[i]),
                   relative = error == 0. ? 0. : error / gap_terms[i];
      if (!(relative <= max) && !std::isnan(max))
      {
        max = relative;
        worst = i;
      }
    }
    return max;
  }

  /// A displacement rounds with the largest of its body.
  void ConstraintMotions::add_body_terms(const BodyVectors &U)
  {
    std::vector<PerKind> size;
    for (std::size_t k = 0; k < structure.size(); ++k)
      size.push_back(largest(structure[k], U[k]));
    std::vector<double> terms(constraints.size(), 0.);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const auto &[k, form, of] : constraints[i].terms)
        for (std::size_t j = 0; j < form.index.size(); ++j)
          terms[i] += std::fabs(form.value[j]) * size[k][structure[k].kind(form.index[j])];
    structure.communicator().sum(terms);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      gap_terms[i] = std::max(gap_terms[i], std::fabs(constraints[i].gap) + terms[i]);
  }

  bool ConstraintMotions::stays_closed(const std::size_t i, const State &state) const
  {
    // Part of the distance of its ends, and of the terms of its rate, by which one that is closed
    // rounds.
    constexpr double rounding = 1e-9;
    const bool is_inconsistent =
        is_first && std::fabs(rates_before[i]) > rounding * velocity_size[i];
    return !is_inconsistent && constraints[i].direction && S[i] == 0. &&
           state.geometric_gap[i] - turning.increment(i) <= rounding * turning.distance(i);
  }

  double ConstraintMotions::drift(const State &state) const
  {
    double largest = 0.;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (velocity_level(i) && !constraints[i].unilateral)
        largest = std::max(largest, std::fabs(state.geometric_gap[i]));
    return largest;
  }
} // namespace taut
