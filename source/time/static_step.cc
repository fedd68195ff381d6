// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/static_step.h"

#include "complementarity/active_set_system.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Iterative refinement ends where the error of the closed constraints is a few roundings, or
    /// where it no longer falls. Each gains at least the six digits that FactoredStructure leaves:
    /// two are enough, one more sees that the error stays.
    constexpr double rounding = 1e-15;
    constexpr int most_refinements = 3;

    /// Part of the terms of a gap below which its constraint touches: three digits above that to
    /// which gaps are solved.
    constexpr double touching = 1e-9;

    /// |x| over size; 0 if x is.
    double relative(const double x, const double size)
    {
      return x == 0. ? 0. : std::fabs(x) / size;
    }

    /// Forces of linear bodies count from those of the undeformed bodies.
    Reference undeformed_bodies(const Structure &structure)
    {
      Reference result;
      result.displacement = result.force = structure.zero();
      structure.communicator().agree(
          [&]
          {
            for (std::size_t k = 0; k < structure.size(); ++k)
              if (structure[k].is_linear())
                structure[k].internal_force(result.displacement[k], {}, result.force[k]);
          });
      return result;
    }

    State start_at(const Structure &structure, const Constraints &constraints,
                   const Reference &undeformed, const double t, const BodyVectors &U)
    {
      State state = state_at_rest(structure, constraints.size());
      state.time = t;
      state.U = U;
      structure.communicator().agree(
          [&]
          {
            for (std::size_t k = 0; k < structure.size(); ++k)
            {
              std::vector<double> &KU = state.KU[k];
              structure[k].internal_force(U[k], {}, KU);
              for (std::size_t i = 0; i < KU.size(); ++i)
                KU[i] -= undeformed.force[k][i];
            }
          });
      state.distance = constraints.motions(U);
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        state.distance[i] += constraints[i].gap;
        state.springs[i].u = std::max(0., -state.distance[i]);
      }
      state.complementarity_gap = state.distance;
      return state;
    }
  } // namespace

  StaticStep::StaticStep(const Structure &structure, const Constraints &constraints,
                         const SolverParameters &parameters, const double t, const BodyVectors &U)
      : structure(structure), constraints(constraints), undeformed(undeformed_bodies(structure)),
        state(start_at(structure, constraints, undeformed, t, U)),
        method(method_at_rest(constraints.size())), nonlinear(structure, undeformed, method),
        none(constraints, undeformed, method),
        step(structure, constraints, parameters, undeformed, method, nonlinear, none, state)
  {
    nonlinear.begin(state);
    step.prepare();
    step.contacts().count_motions(U);
  }

  StaticState StaticStep::solve()
  {
    step.set_loads(state);
    P = step.history().loads();
    find_increments();
    step.accept(state);
    refine();
    return {state.U,
            state.multiplier,
            state.complementarity_gap,
            state.distance,
            {},
            repeated_rows().all_partners()};
  }

  void StaticStep::find_increments()
  {
    try
    {
      step.find_increments(state, residuals);
    }
    catch (const BodyNotHeld &e)
    {
      structure.communicator().agree([&] { fail_not_held(e); });
      throw;
    }
  }

  /// Names the body that the first null space vector belongs to, on its rank.
  void StaticStep::fail_not_held(const BodyNotHeld &e) const
  {
    const std::size_t k = step.equations().body_of_mode(e.null_space().front());
    if (k != Structure::elsewhere)
      throw BodyNotHeld("static equilibrium: body '" + structure[k].name() +
                            "' is not held: no admissible contact force balances its loads. "
                            "Add a support or a link, or start with 'Start = undeformed'.",
                        {}, structure[k].origin());
  }

  /// The largest gap of the closed constraints over the motions that it is summed from, or load of
  /// the null space over its forces.
  double StaticStep::relative_remainder() const
  {
    std::vector<double> moved(constraints.size()), size(constraints.size());
    constraints.share_of_motions(state.U, moved, size);
    constraints.sum(size);
    double largest = 0.;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (step.contacts().applied().closed[i])
        largest = std::max(largest, relative(state.complementarity_gap[i],
                                             size[i] + std::fabs(constraints[i].gap)));
    const MixedComplementarityProblem &problem = step.contacts().problem_of_step();
    std::vector<double> forces, sizes;
    problem.forces_on_null_space(state.multiplier, forces);
    problem.sizes_on_null_space(state.multiplier, sizes);
    for (std::size_t m = 0; m < forces.size(); ++m)
      largest = std::max(largest, relative(problem.null_space_load[m] + forces[m],
                                           problem.null_space_terms[m] + sizes[m]));
    return constraints.max(largest);
  }

  /**
   * Iterative refinement. F N + d adds what A^-1 makes of loads and of contact forces apart from
   * each other, and where springs stand in for the contacts that hold a body, the two are large
   * and cancel; A^-1 (P + B N) does not. What is left there of gaps, and of the balance of rigid
   * body modes, is solved for once more, while it becomes less.
   */
  void StaticStep::refine()
  {
    const std::vector<char> &closed = step.contacts().applied().closed;
    if (!constraints.any(std::count(closed.begin(), closed.end(), 0) !=
                         static_cast<std::ptrdiff_t>(closed.size())))
      return;
    double error = relative_remainder();
    for (int refinement = 0; refinement < most_refinements && error > rounding; ++refinement)
    {
      const State before = state;
      const MixedComplementaritySolution applied = step.contacts().applied();
      BodyVectors forces = P;
      constraints.add_forces(state.multiplier, forces);
      step.history().loads() = structure.zero();
      if (!step.correct(state, forces))
        return;
      const double refined = relative_remainder();
      if (!(refined < error))
      {
        state = before;
        step.contacts().restore(applied, state);
        return;
      }
      error = refined;
    }
  }

  bool StaticStep::flexibility(const std::vector<std::size_t> &rows,
                               std::vector<std::vector<double>> &result)
  {
    const ContactStep &contacts = step.contacts();
    const std::vector<double> &compliance = contacts.compliance();
    MixedComplementarityProblem unit = contacts.problem_of_step();
    std::vector<std::size_t> closed;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (contacts.applied().closed[i] ||
          std::fabs(state.complementarity_gap[i]) <= touching * unit.gap_scale[i])
        closed.push_back(i);
    unit.gap_scale.clear();
    std::fill(unit.null_space_load.begin(), unit.null_space_load.end(), 0.);
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
      if (answers.solve(unit, step.equations().interface().matrix(), closed,
                        options.linear_tolerance, answer,
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

  Residuals StaticStep::certify()
  {
    step.measure_balance(state, residuals);
    step.certify(state, residuals);
    const InterfaceStatistics solves = step.interface_statistics();
    residuals.n_systems = solves.n_systems;
    residuals.n_products = solves.n_applications;
    residuals.n_inner_iterations = solves.n_iterations;
    return residuals;
  }
} // namespace taut
