// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_verification_interface_problem_h
#define taut_verification_interface_problem_h

#include <taut/complementarity/active_set_system.h>
#include <taut/interface/schur_complement.h>
#include <taut/model/scene_rows.h>
#include <taut/partition/make_partition.h>

#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace verification
{
  /// A scene cut by METIS, all rows closed, own weight as load: the linear system of the interface.
  class InterfaceProblem
  {
  public:
    InterfaceProblem(taut::Scene model, const unsigned int n_parts)
        : InterfaceProblem(std::move(model), {"METIS", n_parts, ""})
    {
    }

    /// The same with the cuts that the parameters say.
    InterfaceProblem(taut::Scene model, const taut::PartitionParameters &cuts)
        : scene(std::move(model)), structure(scene, make_partition(scene, cuts)),
          rows(scene_rows(scene, structure))
    {
      rows.update(0.);
    }

    struct Solution
    {
      std::vector<double> multiplier;
      taut::InterfaceStatistics statistics;
      std::string description;
      bool is_solved = false;
    };

    /// Solves F x = -d of a step by backward Euler [s], or with the kernels in statics (step 0), to
    /// a relative residual of @p tolerance in rows scaled to a unit diagonal.
    Solution solve(const double step, const taut::InterfaceParameters &parameters,
                   const double tolerance) const
    {
      taut::FactoredStructure solvers(structure, "block tridiagonal");
      std::vector<taut::Substructure::Kernel> kernels;
      for (std::size_t k = 0; step == 0. && k < structure.size(); ++k)
        kernels.push_back(structure[k].kernel());
      if (step > 0.)
        solvers.factor(1. / (step * step), 1. / step);
      else
        solvers.factor_stiffness(kernels);
      std::vector<double> S(rows.size());
      for (std::size_t i = 0; i < S.size(); ++i)
        S[i] = 1. / (rows[i].stiffness + (step > 0. ? rows[i].damping / step : 0.));
      const auto schur = taut::make_schur_complement(parameters, solvers, rows);
      schur->setup(S);

      taut::BlockVector P(structure.size());
      for (std::size_t k = 0; k < P.size(); ++k)
        structure[k].external_force(0., P[k]);
      taut::MixedComplementarityProblem problem;
      problem.unilateral.assign(rows.size(), 0);
      schur->free_motion(P, problem.free_gap, problem.gap_scale);
      set_kernel(kernels, P, problem);
      Solution solution = solve(problem, schur->matrix(), tolerance);
      solution.statistics = schur->statistics();
      solution.description = schur->description();
      return solution;
    }

    const taut::Scene scene;
    const taut::SceneBodies structure;

  private:
    void set_kernel(const std::vector<taut::Substructure::Kernel> &kernels,
                    const taut::BlockVector &P, taut::MixedComplementarityProblem &problem) const
    {
      std::vector<std::size_t> first;
      for (std::size_t k = 0; k < kernels.size(); ++k)
      {
        first.push_back(problem.kernel_load.size());
        for (const std::vector<double> &R : kernels[k].vectors)
          problem.kernel_load.push_back(std::inner_product(R.begin(), R.end(), P[k].begin(), 0.));
      }
      problem.kernel.resize(problem.kernel_load.size());
      for (std::size_t i = 0; !kernels.empty() && i < rows.size(); ++i)
        for (const taut::Term &term : rows[i].terms)
          for (std::size_t v = 0; v < kernels[term.substructure].vectors.size(); ++v)
            problem.kernel[first[term.substructure] + v].add(
                i, term.form.dot(kernels[term.substructure].vectors[v]));
    }

    Solution solve(const taut::MixedComplementarityProblem &problem,
                   taut::ComplementarityOperator &F, const double tolerance) const
    {
      std::vector<double> rhs = problem.free_gap, load = problem.kernel_load, alpha;
      for (std::vector<double> *v : {&rhs, &load})
        for (double &value : *v)
          value = -value;
      std::vector<std::size_t> all(rows.size());
      std::iota(all.begin(), all.end(), 0);
      F.set_tolerance(tolerance);
      Solution solution;
      if (load.empty())
        solution.is_solved = F.solve(all, rhs, 0., solution.multiplier);
      else if (F.has_kernel_solver())
        solution.is_solved =
            F.solve_with_kernel(all, rhs, problem.kernel, load, 0., solution.multiplier, alpha);
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

    taut::ContactRows rows;
  };
} // namespace verification

#endif
