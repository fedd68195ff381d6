// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/divisible_solid.h"
#include <taut/scene/body_type.h>

namespace taut
{
  template <int dim>
  DivisibleSolid<dim>::DivisibleSolid(std::shared_ptr<const SolidMesh<dim>> given,
                                      const Options &chosen)
      : mesh(std::move(given)), options(chosen), conditions(*mesh, options.conditions),
        division(mesh->dof_handler(), mesh->mapping(), conditions.constraints()),
        mass_factors(ElasticSolid<dim>::mass_factors(*mesh, options, conditions)),
        cell_of_dof(cells().n_dofs())
  {
    for (std::size_t c = 0; c < cells().size(); ++c)
      for (std::size_t e = cells().begin[c]; e < cells().begin[c + 1]; ++e)
        cell_of_dof[cells().dofs[e]] = c;
  }

  template <int dim>
  std::size_t DivisibleSolid<dim>::cell_at_node(const unsigned int node) const
  {
    return cell_of_dof[mesh->whole_surface().dofs[node][0]];
  }

  template <int dim>
  std::unique_ptr<Substructure>
  DivisibleSolid<dim>::make_part(const BodySetting &setting,
                                 const std::vector<unsigned int> &part) const
  {
    std::vector<typename FEBody<dim>::Cell> own;
    for (const unsigned int cell : part)
      own.push_back(mesh->cells()[cell]);
    return std::make_unique<ElasticSolid<dim>>(setting.name, mesh, options, conditions, own,
                                               mass_factors);
  }

  template class DivisibleSolid<2>;
  template class DivisibleSolid<3>;
} // namespace taut
