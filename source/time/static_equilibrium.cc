// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/complementarity/active_set_system.h>
#include <taut/complementarity/solver.h>
#include <taut/interface/schur_complement.h>
#include <taut/time/balance_certificate.h>
#include <taut/time/mode_equations.h>
#include <taut/time/static_equilibrium.h>
#include <taut/time/step_check.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Iterative refinement ends where the error of the closed constraints is rounding, or here.
    constexpr double rounding = 1e-15;
    constexpr int most_refinements = 3;

    /// Part of the largest multiplier by which refinement may make one negative.
    constexpr double admissible = 1e-12;

    /// |x| over size; 0 if x is.
    double relative(const double x, const double size)
    {
      return x == 0. ? 0. : std::fabs(x) / size;
    }

    /**
     * K U = P + B N from the undeformed state, with U = A^-1 (P + B N) + lift + R alpha: A is K
     * with springs on the DoFs that fix the null space R of bodies that only constraints hold, lift
     * the given displacements of supports.
     */
    class StaticStep
    {
    public:
      StaticStep(const Structure &structure, const Constraints &constraints,
                 const SolverParameters &parameters, double t);
      StaticState solve();

    private:
      void set_loads(double t);
      void set_problem();
      std::size_t set_modes(const BodyVectors &forces, MixedComplementarityProblem &target) const;
      void find_multipliers();
      void fail_not_held(const BodyNotHeld &e) const;
      StaticState displaced(const MixedComplementaritySolution &by) const;
      double find_remainder(const StaticState &state, const std::vector<std::size_t> &set,
                            MixedComplementarityProblem &left) const;
      bool correct(const MixedComplementarityProblem &left, const StaticState &state,
                   std::vector<std::size_t> &set, MixedComplementaritySolution &refined) const;
      void refine(StaticState &state);
      void certify(StaticState &state) const;

      const Structure &structure;
      const Constraints &constraints;
      const SolverParameters &parameters;
      const Communicator &processes;
      const double time;
      StepCheck check;
      std::vector<Substructure::NullSpace> null_spaces;
      FactoredStructure solvers;
      std::unique_ptr<SchurComplement> schur;
      std::vector<double> compliance;
      BodyVectors P, lift;
      MixedComplementarityProblem problem;
      std::size_t first_mode = 0; ///< of this rank, among the amplitudes of all
      MixedComplementaritySolution solution;
      Certificate certificate;
    };

    StaticStep::StaticStep(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters, const double t)
        : structure(structure), constraints(constraints), parameters(parameters),
          processes(structure.communicator()), time(t),
          check(structure, constraints, parameters.contact_tolerance),
          solvers(structure, parameters.local_solver)
    {
      for (std::size_t k = 0; k < structure.size(); ++k)
        null_spaces.push_back(structure[k].null_space());
      processes.agree([&] { solvers.factor_stiffness(null_spaces); });
      for (std::size_t i = 0; i < constraints.size(); ++i)
        compliance.push_back(1. / constraints[i].stiffness);
      schur = make_schur_complement(parameters.interface, solvers, constraints);
      schur->setup(compliance);
      processes.agree([&] { set_loads(t); });
      set_problem();
    }

    StaticState StaticStep::solve()
    {
      find_multipliers();
      StaticState state = displaced(solution);
      refine(state);
      certify(state);
      return state;
    }

    /// P - K lift, and lift.
    void StaticStep::set_loads(const double t)
    {
      P = lift = structure.zero();
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        structure[k].external_force(t, P[k]);
        for (const ConstrainedDof &constraint : structure[k].constraints())
          lift[k][constraint.dof] = constraint.at(t);
        structure[k].stiffness().vmult_add(-1., lift[k].data(), P[k].data());
        for (const ConstrainedDof &constraint : structure[k].constraints())
          P[k][constraint.dof] = 0.;
      }
    }

    void StaticStep::set_problem()
    {
      schur->contact_free_predictor(P, problem.free_gap, problem.gap_scale);
      processes.sum(problem.free_gap);
      processes.sum(problem.gap_scale);
      const std::vector<double> lifted = constraints.motions(lift);
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        problem.unilateral.push_back(constraints[i].unilateral);
        problem.gap_scale[i] += std::fabs(lifted[i]) + std::fabs(constraints[i].gap);
        problem.free_gap[i] += lifted[i] + constraints[i].gap;
      }
      first_mode = set_modes(P, problem);
    }

    std::size_t StaticStep::set_modes(const BodyVectors &forces,
                                      MixedComplementarityProblem &target) const
    {
      ModeVectors vectors;
      for (const Substructure::NullSpace &null_space : null_spaces)
        vectors.push_back(&null_space.vectors);
      return set_mode_equations(vectors, processes, constraints, forces, target);
    }

    void StaticStep::find_multipliers()
    {
      try
      {
        check.solve(
            [&]
            {
              ComplementaritySolver complementarity(parameters.complementarity);
              const ComplementarityResult &result = complementarity.solve(problem, schur->matrix());
              solution = result.solution;
              certificate.iterations = result.iterations;
              certificate.fallback = result.used_fallback;
            });
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
      std::size_t end = first_mode;
      const std::size_t mode = e.null_space().front();
      for (std::size_t k = 0; k < null_spaces.size() && mode >= first_mode; ++k)
      {
        end += null_spaces[k].vectors.size();
        if (mode < end)
          throw BodyNotHeld(check.when() + "body '" + structure[k].name() +
                                "' is not held: no admissible contact force balances its loads. "
                                "Add a support or a link, or start with 'Start = undeformed'.",
                            {}, structure[k].origin());
      }
    }

    StaticState StaticStep::displaced(const MixedComplementaritySolution &by) const
    {
      StaticState state;
      state.multiplier = by.multiplier;
      state.displacement = P;
      constraints.add_forces(state.multiplier, state.displacement);
      solvers.solve(state.displacement);
      std::size_t mode = first_mode;
      for (std::size_t k = 0; k < null_spaces.size(); ++k)
      {
        std::vector<double> &U = state.displacement[k];
        for (std::size_t i = 0; i < U.size(); ++i)
          U[i] += lift[k][i];
        for (const std::vector<double> &R : null_spaces[k].vectors)
        {
          for (std::size_t i = 0; i < U.size(); ++i)
            U[i] += by.mode_amplitude[mode] * R[i];
          ++mode;
        }
      }
      state.geometric_gap = constraints.motions(state.displacement);
      state.gap.resize(constraints.size());
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        state.geometric_gap[i] += constraints[i].gap;
        state.gap[i] = state.geometric_gap[i] + compliance[i] * state.multiplier[i];
      }
      return state;
    }

    /// What gaps and loads of the null space lack: the problem of a correction. Returns the largest
    /// gap of the set over the motions that it is summed from, or load over the forces.
    double StaticStep::find_remainder(const StaticState &state, const std::vector<std::size_t> &set,
                                      MixedComplementarityProblem &left) const
    {
      const std::size_t n = constraints.size();
      BodyVectors forces = P;
      constraints.add_forces(state.multiplier, forces);
      set_modes(forces, left);
      left.free_gap = state.gap;
      std::vector<double> size(n, 0.);
      for (std::size_t i = 0; i < n; ++i)
        size[i] = magnitude(constraints[i].terms, state.displacement);
      processes.sum(size);
      double largest = 0.;
      for (const std::size_t i : set)
        largest =
            std::max(largest, relative(state.gap[i], size[i] + std::fabs(constraints[i].gap)));
      for (std::size_t m = 0; m < left.n_null_space(); ++m)
      {
        const LinearForm &G = left.null_space[m];
        double terms = 0.;
        for (std::size_t e = 0; e < G.index.size(); ++e)
          terms += std::fabs(G.value[e] * state.multiplier[G.index[e]]);
        largest = std::max(largest, relative(left.null_space_load[m], terms));
      }
      return largest;
    }

    /// The solution with what removes the remainder on the set; false if there is nothing
    /// admissible. Constraints that touch without a force come into the set where they may be what
    /// holds a body.
    bool StaticStep::correct(const MixedComplementarityProblem &left, const StaticState &state,
                             std::vector<std::size_t> &set,
                             MixedComplementaritySolution &refined) const
    {
      const ComplementarityOptions options;
      ActiveSetSystem system(options);
      MixedComplementaritySolution correction;
      std::vector<double> terms;
      const auto is_solved = [&]
      {
        return system.solve(left, schur->matrix(), set, options.linear_tolerance, correction,
                            terms) != ActiveSetSystem::Outcome::inadmissible;
      };
      if (!is_solved())
      {
        set.clear();
        for (std::size_t i = 0; i < constraints.size(); ++i)
          if (solution.closed[i] || state.gap[i] <= 0.)
            set.push_back(i);
        if (!is_solved())
          return false;
      }
      refined = solution;
      double largest = 0., smallest = 0.;
      for (const std::size_t i : set)
      {
        refined.multiplier[i] += correction.multiplier[i];
        largest = std::max(largest, std::fabs(refined.multiplier[i]));
        if (constraints[i].unilateral)
          smallest = std::min(smallest, refined.multiplier[i]);
      }
      for (std::size_t m = 0; m < left.n_null_space(); ++m)
        refined.mode_amplitude[m] += correction.mode_amplitude[m];
      return smallest >= -admissible * largest;
    }

    /**
     * Iterative refinement on the constraints that are closed. F N + d adds what A^-1 makes of
     * loads and of contact forces apart from each other, and where springs stand in for the
     * contacts that hold a body, the two are large and cancel; A^-1 (P + B N) does not. What is
     * left of gaps and balance there is solved for once more, and kept if it becomes less.
     */
    void StaticStep::refine(StaticState &state)
    {
      std::vector<std::size_t> set;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if (solution.closed[i])
          set.push_back(i);
      if (set.empty())
        return;
      MixedComplementarityProblem left;
      left.unilateral.assign(constraints.size(), 0);
      double error = find_remainder(state, set, left);
      for (int refinement = 0; refinement < most_refinements && error > rounding; ++refinement)
      {
        MixedComplementaritySolution refined;
        if (!correct(left, state, set, refined))
          return;
        StaticState refined_state = displaced(refined);
        const double refined_error = find_remainder(refined_state, set, left);
        if (!(refined_error < error))
          return;
        error = refined_error;
        solution = std::move(refined);
        state = std::move(refined_state);
      }
    }

    /// The same certificate as of a step in time, with nothing that moves.
    void StaticStep::certify(StaticState &state) const
    {
      Certificate found = certificate;
      if (constraints.size() > 0)
      {
        MixedComplementaritySolution certified = solution;
        certified.gap = state.gap;
        const ComplementarityResidual result = residual(problem, schur->matrix(), certified);
        found.complementarity = result.max;
        found.worst_constraint =
            std::max_element(result.rows.begin(), result.rows.end()) - result.rows.begin();
      }
      Reference undeformed;
      State at_rest;
      at_rest.time = time;
      at_rest.U = at_rest.dU = state.displacement;
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
            BalanceCertificate balance(structure, constraints, undeformed);
            own_balance =
                balance.measure(StepCoefficients(), forces, state.multiplier, {}, at_rest);
            found.worst_body = balance.worst_body();
          });
      found.balance = processes.max(own_balance);
      check.check_constraints(found);
      check.check_balance(found, own_balance);
      state.certificate = found;
    }
  } // namespace

  StaticState static_equilibrium(const Structure &structure, const Constraints &constraints,
                                 const SolverParameters &parameters, const double t)
  {
    return StaticStep(structure, constraints, parameters, t).solve();
  }
} // namespace taut
