// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/complementarity/active_set_system.h>
#include <taut/complementarity/solver.h>
#include <taut/interface/schur_complement.h>
#include <taut/time/matrix_norms.h>
#include <taut/time/mode_equations.h>
#include <taut/time/static_equilibrium.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace taut
{
  namespace
  {
    /// |x| over size; 0 if x is.
    double relative(const double x, const double size)
    {
      return x == 0. ? 0. : std::fabs(x) / size;
    }

    /// P - K (given displacements of supports), and those displacements.
    void set_loads(const Structure &structure, const double t, BodyVectors &P, BodyVectors &lift)
    {
      P = structure.zero();
      lift = structure.zero();
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

    std::size_t set_null_space(const std::vector<Substructure::NullSpace> &null_spaces,
                               const Communicator &processes, const Constraints &constraints,
                               const BodyVectors &P, MixedComplementarityProblem &problem)
    {
      ModeVectors vectors;
      for (const Substructure::NullSpace &null_space : null_spaces)
        vectors.push_back(&null_space.vectors);
      return set_mode_equations(vectors, processes, constraints, P, problem);
    }

    /// The body that null space vector @p index belongs to; null if it is on another rank, whose
    /// first vector is not @p first.
    const Substructure *body_of_null_space(const std::vector<Substructure::NullSpace> &null_spaces,
                                           const Structure &structure, const std::size_t first,
                                           const std::size_t index)
    {
      std::size_t end = first;
      for (std::size_t k = 0; k < null_spaces.size(); ++k)
      {
        end += null_spaces[k].vectors.size();
        if (index >= first && index < end)
          return &structure[k];
      }
      return nullptr;
    }

    /// U = A^-1 (P + B N) + given displacements + R alpha, and the gaps that follow from it.
    void displace(const FactoredStructure &solvers, const Constraints &constraints,
                  const std::vector<Substructure::NullSpace> &null_spaces,
                  const std::size_t first_null_space, const BodyVectors &P, const BodyVectors &lift,
                  const std::vector<double> &compliance,
                  const MixedComplementaritySolution &solution, StaticState &state)
    {
      state.multiplier = solution.multiplier;
      state.displacement = P;
      constraints.add_forces(state.multiplier, state.displacement);
      solvers.solve(state.displacement);
      std::size_t amplitude = first_null_space;
      for (std::size_t k = 0; k < null_spaces.size(); ++k)
      {
        std::vector<double> &U = state.displacement[k];
        for (std::size_t i = 0; i < U.size(); ++i)
          U[i] += lift[k][i];
        for (const std::vector<double> &R : null_spaces[k].vectors)
        {
          for (std::size_t i = 0; i < U.size(); ++i)
            U[i] += solution.mode_amplitude[amplitude] * R[i];
          ++amplitude;
        }
      }
      state.geometric_gap = constraints.motions(state.displacement);
      state.gap.resize(constraints.size());
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        state.geometric_gap[i] += constraints[i].gap;
        state.gap[i] = state.geometric_gap[i] + compliance[i] * state.multiplier[i];
      }
    }

    /**
     * Iterative refinement on the constraints that are closed. F N + d adds what A^-1 makes of
     * loads and of contact forces apart from each other, and where springs stand in for the
     * contacts that hold a body, the two are large and cancel; A^-1 (P + B N) does not. What is
     * left of gaps and balance there is solved for once more, and kept if it becomes less.
     */
    void refine(const FactoredStructure &solvers, const Constraints &constraints,
                ComplementarityOperator &matrix,
                const std::vector<Substructure::NullSpace> &null_spaces, const BodyVectors &P,
                const BodyVectors &lift, const std::vector<double> &compliance,
                MixedComplementaritySolution &solution, StaticState &state)
    {
      const std::size_t n = constraints.size();
      const Communicator &processes = solvers.structure().communicator();
      std::vector<std::size_t> set;
      for (std::size_t i = 0; i < n; ++i)
        if (solution.closed[i])
          set.push_back(i);
      if (set.empty())
        return;

      MixedComplementarityProblem left;
      std::size_t first_null_space = 0;
      // Largest gap of the set over the motions it is summed from, and what is not balanced.
      const auto error = [&]
      {
        BodyVectors forces = P;
        constraints.add_forces(state.multiplier, forces);
        first_null_space = set_null_space(null_spaces, processes, constraints, forces, left);
        left.free_gap = state.gap;
        std::vector<double> size(n, 0.);
        for (std::size_t i = 0; i < n; ++i)
          size[i] = magnitude(constraints[i].terms, state.displacement);
        processes.sum(size);
        double largest = 0.;
        for (const std::size_t i : set)
          largest =
              std::max(largest, relative(state.gap[i], size[i] + std::fabs(constraints[i].gap)));
        for (std::size_t k = 0; k < left.n_null_space(); ++k)
        {
          double terms = 0.;
          for (std::size_t e = 0; e < left.null_space[k].index.size(); ++e)
            terms += std::fabs(left.null_space[k].value[e] *
                               state.multiplier[left.null_space[k].index[e]]);
          largest = std::max(largest, relative(left.null_space_load[k], terms));
        }
        return largest;
      };

      left.unilateral.assign(n, 0);
      double last_error = error();
      for (int refinement = 0; refinement < 3 && last_error > 1e-15; ++refinement)
      {
        MixedComplementaritySolution correction;
        std::vector<double> terms;
        const ComplementarityOptions options;
        ActiveSetSystem system(options);
        if (system.solve(left, matrix, set, options.linear_tolerance, correction, terms) ==
            ActiveSetSystem::Outcome::inadmissible)
        {
          // Rows that touch without a force may be what holds a body.
          set.clear();
          for (std::size_t i = 0; i < n; ++i)
            if (solution.closed[i] || state.gap[i] <= 0.)
              set.push_back(i);
          if (system.solve(left, matrix, set, options.linear_tolerance, correction, terms) ==
              ActiveSetSystem::Outcome::inadmissible)
            return;
        }
        MixedComplementaritySolution refined = solution;
        double largest = 0., smallest = 0.;
        for (const std::size_t i : set)
        {
          refined.multiplier[i] += correction.multiplier[i];
          largest = std::max(largest, std::fabs(refined.multiplier[i]));
          if (constraints[i].unilateral)
            smallest = std::min(smallest, refined.multiplier[i]);
        }
        const bool admissible = smallest >= -1e-12 * largest;
        for (std::size_t k = 0; k < left.n_null_space(); ++k)
          refined.mode_amplitude[k] += correction.mode_amplitude[k];
        StaticState refined_state = state;
        displace(solvers, constraints, null_spaces, first_null_space, P, lift, compliance, refined,
                 refined_state);
        std::swap(state, refined_state);
        const double new_error = error();
        if (!admissible || !(new_error < last_error))
        {
          std::swap(state, refined_state);
          return;
        }
        last_error = new_error;
        solution = refined;
      }
    }

    /// Recomputes the balance K U = P + B N of each body, relative to the terms of each kind of
    /// DoF.
    void certify_balance(const Structure &structure, const Constraints &constraints, const double t,
                         StaticState &state)
    {
      BodyVectors r = structure.zero();
      for (std::size_t k = 0; k < structure.size(); ++k)
        structure[k].external_force(t, r[k]);
      constraints.add_forces(state.multiplier, r);
      std::vector<PerKind> contact;
      constraints.largest_forces(state.multiplier, contact);
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        const Substructure &body = structure[k];
        PerKind force = largest(body, r[k]);
        for (int kind = 0; kind < 2; ++kind)
          force[kind] += contact[k][kind];
        const PerKind displacement = largest(body, state.displacement[k]);
        check_size(body, force, displacement, {0., 0.}, "static equilibrium: ");
        const PerKind stiffness = KindNorm(body, body.stiffness()).times(displacement);
        body.stiffness().vmult_add(-1., state.displacement[k].data(), r[k].data());
        for (const ConstrainedDof &constraint : body.constraints())
          r[k][constraint.dof] = 0.;
        const PerKind error = largest(body, r[k]);
        for (int kind = 0; kind < 2; ++kind)
        {
          const double relative =
              error[kind] == 0. ? 0. : error[kind] / (force[kind] + stiffness[kind]);
          if (!(relative <= state.certificate.balance) && !std::isnan(state.certificate.balance))
          {
            state.certificate.balance = relative;
            state.certificate.worst_body = k;
          }
        }
      }
    }

    /// Throws if the tolerance is missed, on all ranks what the rank of the worst body says.
    void check_certificate(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters, const Certificate &certificate,
                           const double own_balance)
    {
      if (certificate.max() <= parameters.contact_tolerance)
        return;
      const auto fail = [&]
      {
        if (own_balance < certificate.balance || structure.size() == 0)
          return;
        std::ostringstream out;
        out << "static equilibrium misses the contact tolerance: residual of the links "
            << certificate.complementarity;
        if (constraints.size() > 0)
          out << " (worst: '" << constraints[certificate.worst_constraint].name << "')";
        out << ", of the force balance " << certificate.balance << " (worst: '"
            << structure[certificate.worst_body].name() << "'), allowed "
            << parameters.contact_tolerance << ". Check stiffnesses for extreme ratios.";
        const bool rows_are_worse = constraints.size() > 0 &&
                                    !(certificate.complementarity <= parameters.contact_tolerance);
        throw EntryError(rows_are_worse ? constraints.origin(certificate.worst_constraint)
                                        : structure[certificate.worst_body].origin(),
                         out.str());
      };
      structure.communicator().agree(fail);
    }
  } // namespace

  StaticState static_equilibrium(const Structure &structure, const Constraints &constraints,
                                 const SolverParameters &parameters, const double t)
  {
    std::vector<Substructure::NullSpace> null_spaces;
    for (std::size_t k = 0; k < structure.size(); ++k)
      null_spaces.push_back(structure[k].null_space());
    const Communicator &processes = structure.communicator();
    FactoredStructure solvers(structure, parameters.local_solver);
    processes.agree([&] { solvers.factor_stiffness(null_spaces); });

    const std::size_t n = constraints.size();
    std::vector<double> compliance(n);
    for (std::size_t i = 0; i < n; ++i)
      compliance[i] = 1. / constraints[i].stiffness;
    const auto schur = make_schur_complement(parameters.interface, solvers, constraints);
    schur->setup(compliance);

    BodyVectors P, lift;
    processes.agree([&] { set_loads(structure, t, P, lift); });

    MixedComplementarityProblem problem;
    schur->contact_free_predictor(P, problem.free_gap, problem.gap_scale);
    processes.sum(problem.free_gap);
    processes.sum(problem.gap_scale);
    const std::vector<double> lifted = constraints.motions(lift);
    for (std::size_t i = 0; i < n; ++i)
    {
      problem.unilateral.push_back(constraints[i].unilateral);
      problem.gap_scale[i] += std::fabs(lifted[i]) + std::fabs(constraints[i].gap);
      problem.free_gap[i] += lifted[i] + constraints[i].gap;
    }
    const std::size_t first_null_space =
        set_null_space(null_spaces, processes, constraints, P, problem);

    StaticState state;
    state.multiplier.assign(n, 0.);
    MixedComplementaritySolution solution;
    try
    {
      ComplementaritySolver complementarity(parameters.complementarity);
      const ComplementarityResult &result = complementarity.solve(problem, schur->matrix());
      solution = result.solution;
      state.certificate.iterations = result.iterations;
      state.certificate.fallback = result.used_fallback;
    }
    catch (const ContradictoryRows &e)
    {
      throw EntryError(e.rows().empty() ? "" : constraints.origin(e.rows().front()),
                       "static equilibrium: the links " + constraints.names(e.rows()) +
                           " contradict each other. Remove one of them, give one a finite "
                           "stiffness, or check the gaps.");
    }
    catch (const NotSolved &e)
    {
      throw UserError(std::string("static equilibrium: ") + e.what());
    }
    catch (const BodyNotHeld &e)
    {
      processes.agree(
          [&]
          {
            if (const Substructure *body = body_of_null_space(
                    null_spaces, structure, first_null_space, e.null_space().front()))
              throw BodyNotHeld("static equilibrium: body '" + body->name() +
                                    "' is not held: no admissible contact force balances its "
                                    "loads. Add a support or a link, or start with 'Start = "
                                    "undeformed'.",
                                {}, body->origin());
          });
      throw;
    }
    displace(solvers, constraints, null_spaces, first_null_space, P, lift, compliance, solution,
             state);
    refine(solvers, constraints, schur->matrix(), null_spaces, P, lift, compliance, solution,
           state);
    solution.gap = state.gap;
    if (n > 0)
    {
      const ComplementarityResidual result = residual(problem, schur->matrix(), solution);
      state.certificate.complementarity = result.max;
      state.certificate.worst_constraint =
          std::max_element(result.rows.begin(), result.rows.end()) - result.rows.begin();
    }
    processes.agree([&] { certify_balance(structure, constraints, t, state); });
    const double own_balance = state.certificate.balance;
    state.certificate.balance = processes.max(own_balance);
    check_certificate(structure, constraints, parameters, state.certificate, own_balance);
    return state;
  }
} // namespace taut
