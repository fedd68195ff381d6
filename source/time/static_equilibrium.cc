// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/complementarity/solver.h>
#include <taut/interface/schur_complement.h>
#include <taut/time/matrix_norms.h>
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
    /// P - K (given displacements of supports), and those displacements.
    void set_loads(const Structure &structure, const double t, BlockVector &P, BlockVector &lift)
    {
      P = structure.zero();
      lift = structure.zero();
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        structure[k].external_force(t, P[k]);
        for (const ConstrainedDof &constraint : structure[k].constraints())
          lift[k][constraint.dof] = constraint.motion(0., t);
        structure[k].stiffness().vmult_add(-1., lift[k].data(), P[k].data());
        for (const ConstrainedDof &constraint : structure[k].constraints())
          P[k][constraint.dof] = 0.;
      }
    }

    /// G_ki = R_k . B_i and e_k = R_k . P of the free motions of all bodies.
    void set_kernel(const std::vector<Substructure::Kernel> &kernels, const ContactRows &rows,
                    const BlockVector &P, MixedComplementarityProblem &problem)
    {
      for (std::size_t k = 0; k < kernels.size(); ++k)
        for (const std::vector<double> &R : kernels[k].vectors)
        {
          for (std::size_t i = 0; i < rows.size(); ++i)
          {
            double g = 0.;
            for (const Term &term : rows[i].terms)
              if (term.substructure == k)
                g += term.form.dot(R);
            problem.kernel.push_back(g);
          }
          problem.kernel_load.push_back(std::inner_product(R.begin(), R.end(), P[k].begin(), 0.));
        }
    }

    /// The body that kernel vector @p index belongs to.
    const Substructure &body_of_kernel(const std::vector<Substructure::Kernel> &kernels,
                                       const Structure &structure, std::size_t index)
    {
      for (std::size_t k = 0; k < kernels.size(); ++k)
      {
        if (index < kernels[k].vectors.size())
          return structure[k];
        index -= kernels[k].vectors.size();
      }
      throw std::logic_error("a kernel vector without a body");
    }

    /// Recomputes the balance K U = P + B N of each body, relative to the terms of each kind of
    /// DoF.
    void certify_balance(const Structure &structure, const ContactRows &rows, const double t,
                         StaticState &state)
    {
      BlockVector r = structure.zero();
      for (std::size_t k = 0; k < structure.size(); ++k)
        structure[k].external_force(t, r[k]);
      rows.add_forces(state.multiplier, r);
      std::vector<PerKind> contact;
      largest_contact_forces(structure, rows, state.multiplier, contact);
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
  } // namespace

  StaticState static_equilibrium(const Structure &structure, const ContactRows &rows,
                                 const SolverParameters &parameters, const double t)
  {
    std::vector<Substructure::Kernel> kernels;
    for (std::size_t k = 0; k < structure.size(); ++k)
      kernels.push_back(structure[k].kernel());
    FactoredStructure solvers(structure, parameters.local_solver);
    solvers.factor_stiffness(kernels);

    const std::size_t n = rows.size();
    std::vector<double> compliance(n);
    for (std::size_t i = 0; i < n; ++i)
      compliance[i] = 1. / rows[i].stiffness;
    const auto schur = make_schur_complement(parameters.interface_operator, solvers, rows);
    schur->setup(compliance);

    BlockVector P, lift;
    set_loads(structure, t, P, lift);

    MixedComplementarityProblem problem;
    schur->free_motion(P, problem.free_gap);
    problem.free_gap.resize(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      problem.unilateral.push_back(rows[i].unilateral);
      const double lifted = evaluate(rows[i].terms, lift);
      problem.gap_scale.push_back(std::fabs(problem.free_gap[i]) + std::fabs(lifted) +
                                  std::fabs(rows[i].gap));
      problem.free_gap[i] += lifted + rows[i].gap;
    }
    set_kernel(kernels, rows, P, problem);

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
      throw EntryError(e.rows().empty() ? "" : rows.origin(e.rows().front()),
                       "static equilibrium: the links " + rows.names(e.rows()) +
                           " contradict each other. Remove one of them, give one a finite "
                           "stiffness, or check the gaps.");
    }
    catch (const NotSolved &e)
    {
      throw UserError(std::string("static equilibrium: ") + e.what());
    }
    catch (const BodyNotHeld &e)
    {
      const Substructure &body = body_of_kernel(kernels, structure, e.kernel().front());
      throw BodyNotHeld("static equilibrium: body '" + body.name() +
                            "' is not held: no admissible contact force balances its loads. Add a "
                            "support or a link, or "
                            "start with 'Start = undeformed'.",
                        {}, body.origin());
    }
    state.multiplier = solution.multiplier;

    // U = A^-1 (P + B N) + given displacements + R alpha
    rows.add_forces(state.multiplier, P);
    solvers.solve(P);
    state.displacement = std::move(P);
    std::size_t amplitude = 0;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::vector<double> &U = state.displacement[k];
      for (std::size_t i = 0; i < U.size(); ++i)
        U[i] += lift[k][i];
      for (const std::vector<double> &R : kernels[k].vectors)
      {
        for (std::size_t i = 0; i < U.size(); ++i)
          U[i] += solution.kernel_amplitude[amplitude] * R[i];
        ++amplitude;
      }
    }

    for (std::size_t i = 0; i < n; ++i)
    {
      state.geometric_gap.push_back(rows[i].gap + evaluate(rows[i].terms, state.displacement));
      state.gap.push_back(state.geometric_gap[i] + compliance[i] * state.multiplier[i]);
    }
    solution.gap = state.gap;
    if (n > 0)
    {
      const ComplementarityResidual result = residual(problem, schur->matrix(), solution);
      state.certificate.complementarity = result.max;
      state.certificate.worst_row =
          std::max_element(result.rows.begin(), result.rows.end()) - result.rows.begin();
    }
    certify_balance(structure, rows, t, state);

    if (!(state.certificate.max() <= parameters.contact_tolerance))
    {
      std::ostringstream out;
      out << "static equilibrium misses the contact tolerance: residual of the links "
          << state.certificate.complementarity;
      if (n > 0)
        out << " (worst: '" << rows[state.certificate.worst_row].name << "')";
      out << ", of the force balance " << state.certificate.balance << " (worst: '"
          << structure[state.certificate.worst_body].name() << "'), allowed "
          << parameters.contact_tolerance << ". Check stiffnesses for extreme ratios.";
      const bool rows_are_worse =
          n > 0 && !(state.certificate.complementarity <= parameters.contact_tolerance);
      throw EntryError(rows_are_worse ? rows.origin(state.certificate.worst_row)
                                      : structure[state.certificate.worst_body].origin(),
                       out.str());
    }
    return state;
  }
} // namespace taut
