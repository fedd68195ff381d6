// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/step_equations.h"
#include "complementarity/active_set_system.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Part of the largest multiplier, and of the terms of a gap, by which refinement may make a
    /// multiplier negative or close an open gap: that to which gaps are solved,
    /// ComplementarityOptions::linear_tolerance.
    constexpr double admissible = 1e-12;

    /// Number of attempts to replace an indefinite tangent: the last one adds twice the largest
    /// stiffness, see NonlinearBodies::tangent().
    constexpr int most_attempts = 9;
  } // namespace

  StepEquations::StepEquations(const Structure &structure, const Constraints &constraints,
                               const SolverParameters &parameters)
      : structure(structure), constraints(constraints), parameters(parameters),
        solvers(structure, parameters.local_solver),
        schur(make_schur_complement(parameters.interface, solvers, constraints)),
        complementarity(parameters.complementarity)
  {
  }

  void StepEquations::prepare(const StepCoefficients &coefficients, const std::vector<double> &S)
  {
    c = coefficients;
    compliance = S;
    const Communicator &processes = structure.communicator();
    const bool has_tangents = processes.any(!nonlinear.empty());
    bool fails = true;
    for (int attempt = 0; fails; ++attempt)
    {
      bool fails_here = false;
      processes.agree(
          [&]
          {
            try
            {
              factor(attempt);
            }
            catch (const EntryError &) // singular or nearly so
            {
              if (!has_tangents || attempt == most_attempts)
                throw;
              fails_here = true;
            }
          });
      fails = processes.any(fails_here);
    }
    number_modes();
    schur->setup(S);
  }

  /// Factors all bodies, so that tangents are the same on any number of ranks if one is indefinite.
  void StepEquations::factor(const int attempt)
  {
    for (const std::size_t k : nonlinear)
      solvers.set_tangent(k, tangent(k, attempt));
    tangents_are_exact = attempt == 0;
    if (c.is_at_rest())
      solvers.factor_stiffness();
    else
      solvers.factor(c.mass_factor(), c.velocity, parameters.interface.form != "matrix-free");
  }

  void StepEquations::set_nonlinear(const std::vector<std::size_t> &bodies, const Tangent &of_body)
  {
    nonlinear = bodies;
    tangent = of_body;
  }

  void StepEquations::linearise()
  {
    structure.communicator().agree([&] { factor_nonlinear(); });
    number_modes();
    schur->setup(compliance);
  }

  void StepEquations::set_compliance(const std::vector<double> &S)
  {
    if (!constraints.any(S != compliance))
      return;
    compliance = S;
    schur->set_compliance(S);
  }

  void StepEquations::factor_nonlinear()
  {
    for (const std::size_t k : nonlinear)
      for (int attempt = 0;; ++attempt)
        try
        {
          solvers.set_tangent(k, tangent(k, attempt));
          solvers.factor_again(k);
          break;
        }
        catch (const EntryError &) // singular or nearly so
        {
          if (attempt == most_attempts)
            throw;
        }
  }

  /// Numbers modes by rank, then by body.
  void StepEquations::number_modes()
  {
    std::size_t n_own = 0;
    for (const FactoredStructure::RigidBodyModes &modes : solvers.rigid_body_modes())
      n_own += modes.vectors.size();
    const Communicator &processes = structure.communicator();
    processes.gather(n_own, n_of_ranks);
    n_modes = std::accumulate(n_of_ranks.begin(), n_of_ranks.end(), std::size_t(0));
    first_of_body.assign(1, std::accumulate(n_of_ranks.begin(),
                                            n_of_ranks.begin() + processes.rank(), std::size_t(0)));
    for (const FactoredStructure::RigidBodyModes &modes : solvers.rigid_body_modes())
      first_of_body.push_back(first_of_body.back() + modes.vectors.size());
  }

  std::size_t StepEquations::body_of_mode(const std::size_t amplitude) const
  {
    const auto end = std::upper_bound(first_of_body.begin(), first_of_body.end(), amplitude);
    return end == first_of_body.begin() || end == first_of_body.end()
               ? Structure::elsewhere
               : end - first_of_body.begin() - 1;
  }

  void StepEquations::lift(const std::size_t k, const std::vector<double> &L,
                           std::vector<double> &P) const
  {
    if (!c.is_at_rest())
    {
      structure[k].mass().vmult_add(-c.mass_factor(), L.data(), P.data());
      structure[k].damping().vmult_add(-c.velocity, L.data(), P.data());
    }
    solvers.stiffness(k).vmult_add(-1., L.data(), P.data());
  }

  void StepEquations::set_modes(MixedComplementarityProblem &problem) const
  {
    const Communicator &processes = structure.communicator();
    const auto &modes = solvers.rigid_body_modes();
    problem.null_space_resistance.assign(c.is_at_rest() ? 0 : n_modes, 0.);
    if (!c.is_at_rest())
      for (std::size_t k = 0; k < modes.size(); ++k)
        std::copy(modes[k].resistance.begin(), modes[k].resistance.end(),
                  problem.null_space_resistance.begin() +
                      static_cast<std::ptrdiff_t>(first_of_body[k]));
    processes.sum(problem.null_space_resistance);
    MatrixEntries G;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const auto &[k, form, of] : constraints[i].terms)
        for (std::size_t v = 0; v < modes[k].vectors.size(); ++v)
          G.add(constraints.number(i), first_of_body[k] + v, form.dot(modes[k].vectors[v]));
    constraints.sum_entries(G, n_modes);
    problem.null_space.assign(n_modes, {});
    for (std::size_t e = 0; e < G.size(); ++e)
      if (G.value[e] != 0.)
        problem.null_space[G.column[e]].add(static_cast<unsigned int>(constraints.index(G.row[e])),
                                            G.value[e]);
  }

  void StepEquations::set_mode_loads(const BodyVectors &P,
                                     MixedComplementarityProblem &problem) const
  {
    const auto &modes = solvers.rigid_body_modes();
    problem.null_space_load.assign(n_modes, 0.);
    problem.null_space_terms.assign(c.is_at_rest() ? n_modes : 0, 0.);
    for (std::size_t k = 0; k < modes.size(); ++k)
      for (std::size_t v = 0; v < modes[k].vectors.size(); ++v)
      {
        const std::vector<double> &R = modes[k].vectors[v];
        problem.null_space_load[first_of_body[k] + v] =
            std::inner_product(R.begin(), R.end(), P[k].begin(), 0.);
        if (c.is_at_rest())
          for (std::size_t i = 0; i < R.size(); ++i)
            problem.null_space_terms[first_of_body[k] + v] += std::fabs(R[i] * P[k][i]);
      }
    structure.communicator().sum(problem.null_space_load);
    structure.communicator().sum(problem.null_space_terms);
  }

  const MixedComplementaritySolution &
  StepEquations::find_multipliers(const MixedComplementarityProblem &problem,
                                  const StepCheck &check, Residuals &residuals)
  {
    const MixedComplementaritySolution *solution = nullptr;
    const auto find = [&]
    {
      const ComplementarityResult &result = complementarity.solve(problem, schur->matrix());
      residuals.iterations = result.iterations;
      residuals.fallback = result.used_fallback;
      solution = &result.solution;
    };
    check.solve(find);
    return *solution;
  }

  void StepEquations::find_increments(const std::vector<double> &N,
                                      const std::vector<double> &alpha, BodyVectors &P) const
  {
    constraints.add_forces(N, P);
    solvers.solve(P);
    if (!has_modes())
      return;
    for (std::size_t k = 0; k < P.size(); ++k)
    {
      const auto &vectors = solvers.rigid_body_modes()[k].vectors;
      for (std::size_t v = 0; v < vectors.size(); ++v)
        for (std::size_t i = 0; i < P[k].size(); ++i)
          P[k][i] += alpha[first_of_body[k] + v] * vectors[v][i];
    }
  }

  bool StepEquations::correct(const MixedComplementarityProblem &remainder,
                              const MixedComplementaritySolution &applied,
                              MixedComplementaritySolution &correction)
  {
    correction.reset(remainder);
    if (constraints.n_of_all() == 0 && !has_modes())
      return true;
    if (correct_on_closed_set(remainder, applied, correction))
      return true;
    // The unknowns are the new multipliers, not their changes, so that conditions and search are
    // those of a step.
    MixedComplementarityProblem problem = remainder;
    std::vector<double> before(constraints.size());
    std::vector<char> closed = applied.closed;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      before[i] = -applied.multiplier[i];
      closed[i] = closed[i] || remainder.free_gap[i] < 0.;
    }
    gaps(remainder, schur->matrix(), before, std::vector<double>(n_modes, 0.), problem.free_gap);
    std::vector<double> forces;
    problem.forces_on_null_space(before, forces);
    for (std::size_t k = 0; k < n_modes; ++k)
      problem.null_space_load[k] += forces[k];
    try
    {
      ComplementaritySolver search(parameters.complementarity);
      search.start_from(closed);
      correction = search.solve(problem, schur->matrix()).solution;
    }
    catch (const UserError &)
    {
      return false;
    }
    for (std::size_t i = 0; i < constraints.size(); ++i)
      correction.multiplier[i] += before[i];
    return true;
  }

  bool StepEquations::correct_on_closed_set(const MixedComplementarityProblem &remainder,
                                            const MixedComplementaritySolution &applied,
                                            MixedComplementaritySolution &correction)
  {
    std::vector<std::size_t> set;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (applied.closed[i])
        set.push_back(i);
    const ComplementarityOptions options;
    ActiveSetSystem system(options);
    std::vector<double> terms;
    if (system.solve(remainder, schur->matrix(), set, options.linear_tolerance, correction,
                     terms) == ActiveSetSystem::Outcome::inadmissible)
      return false;
    double largest = 0., smallest = 0.;
    bool is_admissible = true;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const double N = applied.multiplier[i] + correction.multiplier[i];
      largest = std::max(largest, std::fabs(N));
      if (remainder.cones[i].is_free())
        continue;
      smallest = std::min(smallest, N);
      if (!applied.closed[i] && remainder.cones[i].may_open() &&
          !(correction.gap[i] >= -admissible * terms[i]))
        is_admissible = false;
    }
    return !constraints.any(!is_admissible) &&
           -constraints.max(-smallest) >= -admissible * constraints.max(largest);
  }
} // namespace taut
