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
        mass_factors(ElasticSolid<dim>::mass_factors(*mesh, options, conditions))
  {
    const BodyCells &own = cells();
    for (const auto &dofs : mesh->whole_surface().dofs)
      cell_of_dof[dofs[0]] = own.size();
    for (std::size_t c = 0; c < own.size(); ++c)
      for (std::size_t e = own.begin[c]; e < own.begin[c + 1]; ++e)
        if (const auto node =
                cell_of_dof.find(own.numbers.empty() ? own.dofs[e] : own.numbers[own.dofs[e]]);
            node != cell_of_dof.end())
          node->second = c;
    // Of the ranks with the node, the one that owns its DoFs.
    const dealii::IndexSet &owned = mesh->dof_handler().locally_owned_dofs();
    for (auto &[dof, cell] : cell_of_dof)
      if (!owned.is_element(dof))
        cell = own.size();
  }

  template <int dim>
  std::size_t DivisibleSolid<dim>::cell_at_node(const unsigned int node) const
  {
    return cell_of_dof.at(mesh->whole_surface().dofs[node][0]);
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
