// SPDX-License-Identifier: LGPL-2.1-or-later
#include "static_step.h"

#include <taut/base/exceptions.h>
#include <taut/complementarity/active_set_system.h>
#include <taut/time/balance_certificate.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Iterative refinement ends where the error of the closed constraints is rounding, or here.
    constexpr double rounding = 1e-15;
    constexpr int most_refinements = 3;

    /// Part of the terms of a gap below which its constraint touches.
    constexpr double touching = 1e-9;

    /// Part of the displacements of bodies that came here by large motions with which gaps round,
    /// whatever their direction.
    constexpr double rounding_of_motions = 1e-3;

    /// Residuals up to this need no second look. It is far below any contact tolerance in use, and
    /// above what a gap that is summed from its largest terms rounds with.
    constexpr double conspicuous = 1e-10;

    /// |x| over size; 0 if x is.
    double relative(const double x, const double size)
    {
      return x == 0. ? 0. : std::fabs(x) / size;
    }
  } // namespace

  StaticStep::StaticStep(const Structure &structure, const Constraints &constraints,
                         const SolverParameters &parameters, const double t,
                         const SofterBodies &bodies_at_rest, const BodyVectors &from)
      : structure(structure), constraints(constraints), soft(bodies_at_rest), from(from),
        processes(structure.communicator()), time(t),
        check(structure, constraints, parameters.contact_tolerance),
        system(structure, constraints, parameters), laws(constraints), shift(constraints.size(), 0.)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      compliance.push_back(constraints[i].spring.compliance());
    if (!soft.nonlinear_bodies().empty())
      system.set_nonlinear(soft.nonlinear_bodies(), [&](const std::size_t k, const int attempt)
                           { return soft.tangent(k, from[k], attempt); });
    system.prepare(StepCoefficients(), compliance);
    processes.agree([&] { set_loads(); });
    set_problem();
  }

  StaticState StaticStep::solve()
  {
    find_multipliers();
    StaticState state = displaced(solution);
    refine(state);
    return state;
  }

  /// P - f - K lift, and lift: what the given displacements of supports lack.
  void StaticStep::set_loads()
  {
    P = lift = structure.zero();
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      structure[k].external_force(time, P[k]);
      soft.force(k, from[k], work);
      for (std::size_t i = 0; i < work.size(); ++i)
        P[k][i] -= work[i];
      for (const ConstrainedDof &constraint : structure[k].constraints())
        lift[k][constraint.dof] = constraint.at(time) - from[k][constraint.dof];
      system.lift(k, lift[k], P[k]);
      for (const ConstrainedDof &constraint : structure[k].constraints())
        P[k][constraint.dof] = 0.;
    }
  }

  void StaticStep::set_problem()
  {
    system.interface().contact_free_predictor(P, problem.free_gap, problem.gap_scale);
    processes.sum(problem.free_gap);
    processes.sum(problem.gap_scale);
    const std::vector<double> lifted = constraints.motions(lift), moved = constraints.motions(from);
    std::vector<PerKind> size;
    for (std::size_t k = 0; k < structure.size(); ++k)
      size.push_back(largest(structure[k], from[k]));
    std::vector<double> motion_size(constraints.size(), 0.);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const auto &[k, form, of] : constraints[i].terms)
        for (std::size_t j = 0; j < form.index.size(); ++j)
          motion_size[i] += std::fabs(form.value[j]) * size[k][structure[k].kind(form.index[j])];
    processes.sum(motion_size);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      problem.cones.push_back(constraints[i].cone);
      problem.gap_scale[i] += std::fabs(lifted[i]) + std::fabs(constraints[i].gap) +
                              std::fabs(moved[i]) + rounding_of_motions * motion_size[i];
      problem.free_gap[i] += lifted[i] + constraints[i].gap + moved[i];
      if (constraints[i].spring.law)
        laws.begin_at_end(i, std::max(0., -constraints[i].gap - moved[i]));
    }
    system.set_modes(P, problem);
  }

  void StaticStep::find_multipliers()
  {
    try
    {
      solution = laws.empty() ? system.find_multipliers(problem, check, certificate)
                              : laws.solve(problem, system, check, certificate, compliance, shift);
    }
    catch (const BodyNotHeld &e)
    {
      processes.agree([&] { fail_not_held(e); });
      throw;
    }
  }

  /// Names the body that the first null space vector belongs to, on its rank.
  void StaticStep::fail_not_held(const BodyNotHeld &e) const
  {
    const std::size_t k = system.body_of_mode(e.null_space().front());
    if (k != Structure::elsewhere)
      throw BodyNotHeld(check.when() + "body '" + structure[k].name() +
                            "' is not held: no admissible contact force balances its loads. "
                            "Add a support or a link, or start with 'Start = undeformed'.",
                        {}, structure[k].origin());
  }

  StaticState StaticStep::displaced(const MixedComplementaritySolution &by) const
  {
    StaticState state;
    state.multiplier = by.multiplier;
    state.displacement = P;
    system.find_increments(by.multiplier, by.mode_amplitude, state.displacement);
    for (std::size_t k = 0; k < structure.size(); ++k)
      for (std::size_t i = 0; i < lift[k].size(); ++i)
        state.displacement[k][i] += lift[k][i] + from[k][i];
    state.geometric_gap = constraints.motions(state.displacement);
    state.gap.resize(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      state.geometric_gap[i] += constraints[i].gap;
      const double u = compliance[i] * state.multiplier[i] + shift[i];
      state.gap[i] = state.geometric_gap[i] + u;
      if (constraints[i].spring.law)
        state.gap[i] += laws.lack(i, u, state.multiplier[i]);
    }
    return state;
  }

  std::vector<double> StaticStep::motion_terms(const BodyVectors &U) const
  {
    std::vector<double> size(constraints.size(), 0.);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      size[i] = magnitude(constraints[i].terms, U);
    processes.sum(size);
    return size;
  }

  /// sum_j |K_ij| |U_j| / K_ii: a displacement rounds with those that its equation ties it to, as
  /// the slope of a beam that is moved without bending does [m, rad].
  BodyVectors StaticStep::terms_of(const BodyVectors &U) const
  {
    BodyVectors terms = structure.zero();
    std::vector<double> diagonal;
    for (std::size_t k = 0; k < U.size(); ++k)
    {
      diagonal.assign(U[k].size(), 0.);
      bodies().stiffness(k).visit(
          [&](const unsigned int i, const unsigned int j, const double value)
          {
            terms[k][i] += std::fabs(value * U[k][j]);
            if (i == j)
              diagonal[i] = value;
            else
              terms[k][j] += std::fabs(value * U[k][i]);
          });
      for (std::size_t i = 0; i < U[k].size(); ++i)
        terms[k][i] = diagonal[i] > 0. ? terms[k][i] / diagonal[i] : std::fabs(U[k][i]);
    }
    return terms;
  }

  /**
   * Residual of the conditions of the constraints, with the gaps of the displacements. An entry of
   * F is a sum over the bodies, whose terms may cancel, as the slopes on both sides of a cut in a
   * straight wire do: a gap rounds with the motions of its ends, too.
   */
  ComplementarityResidual StaticStep::residual_of_gaps(const StaticState &state)
  {
    MixedComplementaritySolution certified = solution;
    certified.gap = state.gap;
    const ComplementarityOperator &F = system.interface().matrix();
    const ComplementarityResidual found = residual(problem, F, certified);
    if (found.max <= conspicuous)
      return found;
    MixedComplementarityProblem with_motions = problem;
    const std::vector<double> size = motion_terms(terms_of(state.displacement));
    for (std::size_t i = 0; i < size.size(); ++i)
      with_motions.gap_scale[i] += size[i];
    return residual(with_motions, F, certified);
  }

  /// What gaps and loads of the null space lack. Returns the largest gap of the closed
  /// constraints over the motions that it is summed from, or load over the forces.
  double StaticStep::find_remainder(const StaticState &state,
                                    MixedComplementarityProblem &remainder) const
  {
    const std::size_t n = constraints.size();
    BodyVectors forces = P;
    constraints.add_forces(state.multiplier, forces);
    system.set_modes(forces, remainder);
    remainder.free_gap = state.gap;
    const std::vector<double> size = motion_terms(state.displacement);
    double largest = 0.;
    for (std::size_t i = 0; i < n; ++i)
      if (solution.closed[i])
        largest =
            std::max(largest, relative(state.gap[i], size[i] + std::fabs(constraints[i].gap)));
    for (std::size_t m = 0; m < remainder.n_null_space(); ++m)
    {
      const LinearForm &G = remainder.null_space[m];
      double terms = 0.;
      for (std::size_t e = 0; e < G.index.size(); ++e)
        terms += std::fabs(G.value[e] * state.multiplier[G.index[e]]);
      largest = std::max(largest, relative(remainder.null_space_load[m], terms));
    }
    return largest;
  }

  /**
   * Iterative refinement. F N + d adds what A^-1 makes of loads and of contact forces apart from
   * each other, and where springs stand in for the contacts that hold a body, the two are large
   * and cancel; A^-1 (P + B N) does not. What is left of gaps and balance there is solved for
   * once more, and kept if it becomes less.
   */
  void StaticStep::refine(StaticState &state)
  {
    if (std::count(solution.closed.begin(), solution.closed.end(), 0) ==
        static_cast<std::ptrdiff_t>(constraints.size()))
      return;
    MixedComplementarityProblem remainder;
    remainder.cones = problem.cones;
    double error = find_remainder(state, remainder);
    for (int refinement = 0; refinement < most_refinements && error > rounding; ++refinement)
    {
      MixedComplementaritySolution refined = solution, correction;
      if (!system.correct(remainder, solution, correction))
        return;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        refined.multiplier[i] += correction.multiplier[i];
      for (std::size_t m = 0; m < remainder.n_null_space(); ++m)
        refined.mode_amplitude[m] += correction.mode_amplitude[m];
      StaticState refined_state = displaced(refined);
      const double refined_error = find_remainder(refined_state, remainder);
      if (!(refined_error < error))
        return;
      error = refined_error;
      solution = std::move(refined);
      state = std::move(refined_state);
    }
  }

  bool StaticStep::flexibility(const std::vector<std::size_t> &rows,
                               std::vector<std::vector<double>> &result)
  {
    MixedComplementarityProblem unit = problem;
    unit.gap_scale.clear();
    std::fill(unit.null_space_load.begin(), unit.null_space_load.end(), 0.);
    std::vector<std::size_t> closed;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (solution.closed[i] || std::fabs(solution.gap[i]) <= touching * problem.gap_scale[i])
        closed.push_back(i);
    const ComplementarityOptions options;
    ActiveSetSystem answers(options);
    MixedComplementaritySolution answer;
    std::vector<double> terms;
    result.clear();
    for (const std::size_t row : rows)
    {
      unit.free_gap.assign(constraints.size(), 0.);
      unit.free_gap[row] = -compliance[row];
      answer.reset(unit);
      if (answers.solve(unit, system.interface().matrix(), closed, options.linear_tolerance, answer,
                        terms) == ActiveSetSystem::Outcome::inadmissible)
        return false;
      // Under a unit force a spring lacks what it answers to the gap that it would have alone.
      result.emplace_back();
      for (const std::size_t other : rows)
        result.back().push_back(compliance[other] *
                                ((other == row ? 1. : 0.) - answer.multiplier[other]));
    }
    return true;
  }

  /// The same certificate as of a step in time, with nothing that moves.
  void StaticStep::certify(StaticState &state)
  {
    Certificate found = certificate;
    if (constraints.size() > 0)
    {
      const ComplementarityResidual result = residual_of_gaps(state);
      found.complementarity = result.max;
      found.worst_constraint =
          std::max_element(result.rows.begin(), result.rows.end()) - result.rows.begin();
    }
    Reference undeformed;
    State at_rest;
    at_rest.time = time;
    at_rest.U = at_rest.dU = state.displacement;
    undeformed.displacement = structure.zero();
    at_rest.multiplier = state.multiplier;
    StepForces forces;
    for (BodyVectors *v : {&undeformed.force, &at_rest.V, &at_rest.A, &at_rest.KU, &at_rest.balance,
                           &forces.P, &forces.old_A, &forces.old_balance})
      *v = structure.zero();
    double own_balance = 0.;
    processes.agree(
        [&]
        {
          for (std::size_t k = 0; k < structure.size(); ++k)
          {
            structure[k].external_force(time, forces.P[k]);
            forces.external_size.push_back(largest(structure[k], forces.P[k]));
            if (!structure[k].is_linear())
              continue;
            structure[k].internal_force(undeformed.displacement[k], {}, undeformed.force[k]);
            for (std::size_t i = 0; i < forces.P[k].size(); ++i)
              forces.P[k][i] -= undeformed.force[k][i];
          }
          const NonlinearBodies undeformed_bodies(structure, undeformed);
          BalanceCertificate balance(structure, constraints, undeformed, undeformed_bodies);
          balance.measure(StepCoefficients(), forces, state.multiplier, {}, at_rest);
          own_balance = balance.residual();
          found.worst_body = balance.worst_body();
        });
    found.balance = processes.max(own_balance);
    check.check_constraints(found);
    check.check_balance(found, own_balance);
    state.certificate = found;
  }
} // namespace taut
