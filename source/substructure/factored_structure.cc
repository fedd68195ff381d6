// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/factored_structure.h>

#include <algorithm>

namespace taut
{
  FactoredStructure::FactoredStructure(const Structure &structure, const std::string &solver_name)
      : bodies(structure)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      solvers.push_back(make_local_solver(solver_name, structure[k].stiffness()));
  }

  void FactoredStructure::factor(const std::size_t k, const std::vector<ScaledMatrix> &summands)
  {
    try
    {
      solvers[k]->factor(summands, bodies[k].constrained_dofs());
    }
    catch (const BodyNotHeld &e)
    {
      throw BodyNotHeld("body '" + bodies[k].name() + "': " + e.what() +
                            ". Give it mass, stiffness or a support there.",
                        {}, bodies[k].origin());
    }
  }

  void FactoredStructure::factor(const double mass, const double damping)
  {
    for (std::size_t k = 0; k < solvers.size(); ++k)
      factor(k, {{mass, &bodies[k].mass()},
                 {damping, &bodies[k].damping()},
                 {1., &bodies[k].stiffness()}});
  }

  void FactoredStructure::factor_stiffness(const std::vector<Substructure::Kernel> &kernels)
  {
    for (std::size_t k = 0; k < solvers.size(); ++k)
    {
      const auto held = bodies[k].stiffness().clone();
      if (!kernels[k].fixing_dofs.empty())
      {
        std::vector<double> diagonal(bodies[k].n_dofs(), 0.);
        double largest = 0.;
        held->visit(
            [&](unsigned int i, unsigned int j, double value)
            {
              if (i == j)
                largest = std::max(largest, diagonal[i] = value);
            });
        for (const unsigned int dof : kernels[k].fixing_dofs)
          held->add(dof, dof, diagonal[dof] > 0. ? diagonal[dof] : largest > 0. ? largest : 1.);
      }
      factor(k, {{1., held.get()}});
    }
  }

  void FactoredStructure::solve(BlockVector &X) const
  {
    for (std::size_t k = 0; k < solvers.size(); ++k)
      solvers[k]->solve(X[k]);
  }
} // namespace taut
