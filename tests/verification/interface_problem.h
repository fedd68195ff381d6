// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_verification_interface_problem_h
#define taut_verification_interface_problem_h

#include "common.h"
#include "complementarity/solver.h"
#include "interface/schur_complement.h"
#include "model/scene_constraints.h"
#include "partition/make_partition.h"

namespace verification
{
  /// Processor time since @p begin [s]: that of a machine that others use, too.
  inline double seconds_since(const std::clock_t begin)
  {
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  /// A scene cut by METIS, all constraints closed, own weight as load: the linear system of the
  /// interface.
  class InterfaceProblem
  {
  public:
    InterfaceProblem(taut::Scene model, const unsigned int n_parts)
        : InterfaceProblem(std::move(model), {"METIS", std::to_string(n_parts), ""})
    {
    }

    /// The same with the cuts that the parameters say.
    InterfaceProblem(const taut::Scene &model, const taut::PartitionParameters &cuts)
        : InterfaceProblem(model, make_partition(model, cuts))
    {
    }

    InterfaceProblem(taut::Scene model, const taut::Partition &cuts)
        : scene(std::move(model)), structure(scene, cuts),
          constraints(scene_constraints(scene, structure))
    {
      constraints.update(0.);
    }

    struct Solution
    {
      std::vector<double> multiplier;
      taut::InterfaceStatistics statistics;
      std::string description;
      bool is_solved = false;
      double set_up = 0.;  ///< factors and interface operator [s]
      double first = 0.;   ///< the solution, with its preconditioner [s]
      double further = 0.; ///< once more with the preconditioner at hand [s]
    };

    /// Solves F x = -d of a step by backward Euler [s], or with the null spaces in statics (step
    /// 0), to a relative residual of @p tolerance in constraints scaled to a unit diagonal.
    Solution solve(const double step, const taut::InterfaceParameters &parameters,
                   const double tolerance, const bool measure_further = false) const
    {
      const std::clock_t begin = std::clock();
      taut::FactoredStructure solvers(structure, "block tridiagonal");
      std::vector<taut::Substructure::NullSpace> null_spaces;
      for (std::size_t k = 0; step == 0. && k < structure.size(); ++k)
        null_spaces.push_back(structure[k].null_space());
      if (step > 0.)
        solvers.factor(1. / (step * step), 1. / step);
      else
        solvers.factor_stiffness();
      std::vector<double> S(constraints.size());
      for (std::size_t i = 0; i < S.size(); ++i)
        S[i] = 1. / (constraints[i].spring.stiffness +
                     (step > 0. ? constraints[i].spring.damping / step : 0.));
      const auto schur = taut::make_schur_complement(parameters, solvers, constraints);
      schur->setup(S);
      const double set_up = seconds_since(begin);

      taut::BodyVectors P(structure.size());
      for (std::size_t k = 0; k < P.size(); ++k)
        structure[k].external_force(0., P[k]);
      taut::MixedComplementarityProblem problem;
      problem.cones.assign(constraints.size(), taut::Cone::free());
      schur->contact_free_predictor(P, problem.free_gap, problem.gap_scale);
      set_null_space(null_spaces, P, problem);
      const std::clock_t first = std::clock();
      Solution solution = solve(problem, schur->matrix(), tolerance);
      solution.first = seconds_since(first);
      solution.set_up = set_up;
      solution.statistics = schur->statistics();
      solution.description = schur->description();
      if (measure_further)
      {
        const std::clock_t further = std::clock();
        solve(problem, schur->matrix(), tolerance);
        solution.further = seconds_since(further);
      }
      return solution;
    }

    struct Contact
    {
      taut::InterfaceStatistics statistics;
      unsigned int n_sets = 0;  ///< solved for
      std::size_t n_open = 0;   ///< unilateral constraints in the end
      std::size_t n_closed = 0; ///< the same
    };

    /// The equilibrium with its contacts, from the undeformed bodies: a search for the active set,
    /// the last system solved until its gaps are @p tolerance of their terms.
    Contact find_contacts(const taut::InterfaceParameters &parameters, const double tolerance,
                          const std::string &method = "semismooth Newton") const
    {
      taut::FactoredStructure solvers(structure, "block tridiagonal");
      solvers.factor_stiffness();
      std::vector<taut::Substructure::NullSpace> null_spaces;
      taut::BodyVectors P(structure.size());
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        null_spaces.push_back(structure[k].null_space());
        structure[k].external_force(0., P[k]);
      }
      const auto schur = taut::make_schur_complement(parameters, solvers, constraints);
      std::vector<double> S;
      taut::MixedComplementarityProblem problem;
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        S.push_back(constraints[i].spring.compliance());
        problem.cones.push_back(taut::Cone::unilateral_if(constraints[i].cone.may_open()));
      }
      schur->setup(S);
      schur->contact_free_predictor(P, problem.free_gap, problem.gap_scale);
      for (std::size_t i = 0; i < constraints.size(); ++i)
        problem.free_gap[i] += constraints[i].gap;
      set_null_space(null_spaces, P, problem);
      taut::ComplementarityOptions options;
      options.linear_tolerance = tolerance;
      options.dead_band = std::max(options.dead_band, tolerance);
      options.tolerance = std::max(options.tolerance, 10. * tolerance);
      taut::ComplementaritySolver search(method, options);
      const taut::ComplementarityResult &result = search.solve(problem, schur->matrix());
      Contact contact;
      contact.statistics = schur->statistics();
      contact.n_sets = result.iterations;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if (constraints[i].cone.may_open())
          ++(result.solution.closed[i] ? contact.n_closed : contact.n_open);
      return contact;
    }

    const taut::Scene scene;
    const taut::SceneBodies structure;
    taut::Constraints constraints;

  private:
    void set_null_space(const std::vector<taut::Substructure::NullSpace> &null_spaces,
                        const taut::BodyVectors &P,
                        taut::MixedComplementarityProblem &problem) const
    {
      std::vector<std::size_t> first;
      for (std::size_t k = 0; k < null_spaces.size(); ++k)
      {
        first.push_back(problem.null_space_load.size());
        for (const std::vector<double> &R : null_spaces[k].vectors)
          problem.null_space_load.push_back(
              std::inner_product(R.begin(), R.end(), P[k].begin(), 0.));
      }
      problem.null_space.resize(problem.null_space_load.size());
      for (std::size_t i = 0; !null_spaces.empty() && i < constraints.size(); ++i)
        for (const taut::Term &term : constraints[i].terms)
          for (std::size_t v = 0; v < null_spaces[term.substructure].vectors.size(); ++v)
            problem.null_space[first[term.substructure] + v].add(
                i, term.form.dot(null_spaces[term.substructure].vectors[v]));
    }

    Solution solve(const taut::MixedComplementarityProblem &problem,
                   taut::ComplementarityOperator &F, const double tolerance) const
    {
      std::vector<double> rhs = problem.free_gap, load = problem.null_space_load, alpha;
      for (std::vector<double> *v : {&rhs, &load})
        for (double &value : *v)
          value = -value;
      std::vector<std::size_t> all(constraints.size());
      std::iota(all.begin(), all.end(), 0);
      F.set_tolerance(tolerance);
      Solution solution;
      if (load.empty())
        solution.is_solved = F.solve(all, rhs, 0., solution.multiplier);
      else if (F.has_null_space_solver())
        solution.is_solved = F.solve_with_null_space(all, rhs, problem.null_space, load, 0.,
                                                     solution.multiplier, alpha);
      else
      {
        taut::ActiveSetSystem system{taut::ComplementarityOptions()};
        taut::MixedComplementaritySolution result;
        std::vector<double> terms;
        solution.is_solved = system.solve(problem, F, all, 1e-12, result, terms) ==
                             taut::ActiveSetSystem::Outcome::solved;
        solution.multiplier = result.multiplier;
      }
      return solution;
    }
  };
} // namespace verification

#endif
