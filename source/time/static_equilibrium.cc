// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/time/balance_certificate.h>
#include <taut/time/static_equilibrium.h>
#include <taut/time/step_system.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Iterative refinement ends where the error of the closed constraints is rounding, or here.
    constexpr double rounding = 1e-15;
    constexpr int most_refinements = 3;

    /// |x| over size; 0 if x is.
    double relative(const double x, const double size)
    {
      return x == 0. ? 0. : std::fabs(x) / size;
    }

    /// Newton's method for bodies that are not linear ends where the displacements change by this
    /// part of themselves, or no longer by less and by no more than the second one.
    constexpr double converged = 1e-12, stagnated = 1e-7;

    /// Its iterations: with full steps first, then with a line search.
    constexpr int most_full_steps = 20, most_iterations = 300;

    /// Part of the expected decrease of the energy that a step has to make (L. Armijo, 1966).
    constexpr double sufficient = 1e-4;
    constexpr double shortest_step = 1e-6;

    /// The step from a state U, at first the undeformed one, to f(U) + K dU = P + B N.
    class StaticStep
    {
    public:
      StaticStep(const Structure &structure, const Constraints &constraints,
                 const SolverParameters &parameters, double t, const NonlinearBodies &nonlinear,
                 const BodyVectors &from);
      StaticState solve();
      void certify(StaticState &state);

      /// True if all tangents are those of the bodies and positive definite.
      bool has_own_tangents() const { return system.has_own_tangents(); }

    private:
      void set_loads();
      void set_problem();
      void find_multipliers();
      void fail_not_held(const BodyNotHeld &e) const;
      StaticState displaced(const MixedComplementaritySolution &by) const;
      double find_remainder(const StaticState &state, MixedComplementarityProblem &remainder) const;
      void refine(StaticState &state);

      const Structure &structure;
      const Constraints &constraints;
      const NonlinearBodies &nonlinear;
      const BodyVectors &from;
      const Communicator &processes;
      const double time;
      StepCheck check;
      StepSystem system;
      std::vector<double> compliance;
      BodyVectors P, lift;
      std::vector<double> work;
      MixedComplementarityProblem problem;
      MixedComplementaritySolution solution;
      Certificate certificate;
    };

    StaticStep::StaticStep(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters, const double t,
                           const NonlinearBodies &nonlinear, const BodyVectors &from)
        : structure(structure), constraints(constraints), nonlinear(nonlinear), from(from),
          processes(structure.communicator()), time(t),
          check(structure, constraints, parameters.contact_tolerance),
          system(structure, constraints, parameters)
    {
      for (std::size_t i = 0; i < constraints.size(); ++i)
        compliance.push_back(1. / constraints[i].stiffness);
      if (!nonlinear.indices().empty())
        system.set_nonlinear(nonlinear.indices(), [&](const std::size_t k, const int attempt)
                             { return nonlinear.tangent_at(k, from[k], attempt); });
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
        structure[k].internal_force(from[k], {}, work);
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
      const std::vector<double> lifted = constraints.motions(lift),
                                moved = constraints.motions(from);
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        problem.unilateral.push_back(constraints[i].unilateral);
        problem.gap_scale[i] +=
            std::fabs(lifted[i]) + std::fabs(constraints[i].gap) + std::fabs(moved[i]);
        problem.free_gap[i] += lifted[i] + constraints[i].gap + moved[i];
      }
      system.set_modes(P, problem);
    }

    void StaticStep::find_multipliers()
    {
      try
      {
        solution = system.find_multipliers(problem, check, certificate);
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
        state.gap[i] = state.geometric_gap[i] + compliance[i] * state.multiplier[i];
      }
      return state;
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
      std::vector<double> size(n, 0.);
      for (std::size_t i = 0; i < n; ++i)
        size[i] = magnitude(constraints[i].terms, state.displacement);
      processes.sum(size);
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
      remainder.unilateral = problem.unilateral;
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

    /// The same certificate as of a step in time, with nothing that moves.
    void StaticStep::certify(StaticState &state)
    {
      Certificate found = certificate;
      if (constraints.size() > 0)
      {
        MixedComplementaritySolution certified = solution;
        certified.gap = state.gap;
        const ComplementarityResidual result =
            residual(problem, system.interface().matrix(), certified);
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
      for (BodyVectors *v : {&undeformed.force, &at_rest.V, &at_rest.A, &at_rest.KU,
                             &at_rest.balance, &forces.P, &forces.old_A, &forces.old_balance})
        *v = structure.zero();
      double own_balance = 0.;
      processes.agree(
          [&]
          {
            for (std::size_t k = 0; k < structure.size(); ++k)
            {
              structure[k].external_force(time, forces.P[k]);
              forces.external_size.push_back(largest(structure[k], forces.P[k]));
            }
            const NonlinearBodies undeformed_bodies(structure, undeformed);
            BalanceCertificate balance(structure, constraints, undeformed, undeformed_bodies);
            own_balance =
                balance.measure(StepCoefficients(), forces, state.multiplier, {}, at_rest);
            found.worst_body = balance.worst_body();
          });
      found.balance = processes.max(own_balance);
      check.check_constraints(found);
      check.check_balance(found, own_balance);
      state.certificate = found;
    }

    /**
     * Newton's method with the complementarity problem solved exactly in each iteration (N. H.
     * Josephy, 1979), with full steps; if that ends nowhere, or where a tangent is not definite,
     * with a line search on the energy and tangents that are made definite. An equilibrium whose
     * own tangent is not definite is none that a structure stays in.
     */
    class NonlinearEquilibrium
    {
    public:
      NonlinearEquilibrium(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters, const double t,
                           const NonlinearBodies &nonlinear)
          : structure(structure), constraints(constraints), parameters(parameters), time(t),
            nonlinear(nonlinear)
      {
      }

      StaticState find()
      {
        StaticState state;
        if (iterate(false, state) || iterate(true, state))
          return state;
        std::ostringstream out;
        out << "static equilibrium: none that is stable was found; the displacements still change "
            << "by " << change << " of themselves. Check lengths and supports for cables that "
            << "nothing holds in tension, start from 'undeformed', or give them some bending "
            << "stiffness";
        throw UserError(out.str());
      }

    private:
      bool iterate(const bool is_damped, StaticState &state)
      {
        BodyVectors U = structure.zero();
        double before = std::numeric_limits<double>::infinity();
        for (int iteration = 0; iteration < (is_damped ? most_iterations : most_full_steps);
             ++iteration)
        {
          StaticStep step(structure, constraints, parameters, time, nonlinear, U);
          state = step.solve();
          change = relative_change(U, state.displacement);
          if (!std::isfinite(change))
            return false;
          if (change <= converged || (change <= stagnated && change >= .5 * before))
          {
            if (structure.communicator().max(step.has_own_tangents() ? 0. : 1.) > 0.)
              return false;
            step.certify(state);
            return true;
          }
          before = change;
          if (is_damped)
            shorten(U, state);
          U = state.displacement;
        }
        return false;
      }

      double relative_change(const BodyVectors &from, const BodyVectors &to) const
      {
        PerKind moved = {0., 0.}, size = {0., 0.};
        for (std::size_t k = 0; k < structure.size(); ++k)
        {
          std::vector<double> difference = to[k];
          for (std::size_t i = 0; i < difference.size(); ++i)
            difference[i] -= from[k][i];
          const PerKind d = largest(structure[k], difference), u = largest(structure[k], to[k]);
          for (int kind = 0; kind < 2; ++kind)
          {
            moved[kind] = std::isnan(d[kind]) ? std::numeric_limits<double>::infinity()
                                              : std::max(moved[kind], d[kind]);
            size[kind] = std::max(size[kind], u[kind]);
          }
        }
        double result = 0.;
        for (int kind = 0; kind < 2; ++kind)
        {
          const double d = structure.communicator().max(moved[kind]),
                       u = structure.communicator().max(size[kind]);
          if (d > 0.)
            result = std::max(result, d / u);
        }
        return result;
      }

      /// Strain energy, minus the work of loads and of the forces of rigid constraints.
      double energy(const BodyVectors &U, const std::vector<double> &N) const
      {
        double sum = 0.;
        std::vector<double> P;
        for (std::size_t k = 0; k < structure.size(); ++k)
        {
          structure[k].external_force(time, P);
          sum += structure[k].strain_energy(U[k]) -
                 std::inner_product(P.begin(), P.end(), U[k].begin(), 0.);
        }
        structure.communicator().sum(&sum, 1);
        const std::vector<double> motions = constraints.motions(U);
        for (std::size_t i = 0; i < constraints.size(); ++i)
        {
          const double gap = motions[i] + constraints[i].gap, k = constraints[i].stiffness;
          if (std::isinf(k))
            sum -= N[i] * gap;
          else if (!constraints[i].unilateral || gap < 0.)
            sum += .5 * k * gap * gap;
        }
        return sum;
      }

      /// Armijo's condition along the way from U.
      void shorten(const BodyVectors &U, StaticState &state) const
      {
        const BodyVectors end = state.displacement;
        const double start = energy(U, state.multiplier);
        constexpr double difference = 1e-6;
        const auto at = [&](const double s)
        {
          for (std::size_t k = 0; k < U.size(); ++k)
            for (std::size_t i = 0; i < U[k].size(); ++i)
              state.displacement[k][i] = U[k][i] + s * (end[k][i] - U[k][i]);
          return energy(state.displacement, state.multiplier);
        };
        const double slope = (at(difference) - start) / difference;
        for (double s = 1.; s > shortest_step; s *= .5)
          if (at(s) <= start + sufficient * s * std::min(0., slope))
            return;
      }

      const Structure &structure;
      const Constraints &constraints;
      const SolverParameters &parameters;
      const double time;
      const NonlinearBodies &nonlinear;
      double change = 0.;
    };
  } // namespace

  StaticState static_equilibrium(const Structure &structure, const Constraints &constraints,
                                 const SolverParameters &parameters, const double t)
  {
    Reference undeformed;
    undeformed.displacement = undeformed.force = structure.zero();
    const NonlinearBodies nonlinear(structure, undeformed);
    if (!(structure.communicator().max(nonlinear.indices().empty() ? 0. : 1.) > 0.))
    {
      StaticStep step(structure, constraints, parameters, t, nonlinear, undeformed.displacement);
      StaticState state = step.solve();
      step.certify(state);
      return state;
    }
    return NonlinearEquilibrium(structure, constraints, parameters, t, nonlinear).find();
  }
} // namespace taut
