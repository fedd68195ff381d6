// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/solid/solid_mesh.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>

#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <map>

namespace taut
{
  namespace
  {
    template <int dim>
    bool has_simplices(const dealii::Triangulation<dim> &cells)
    {
      if (cells.n_active_cells() == 0)
        throw UserError("the mesh has no cells");
      if (!cells.all_reference_cells_are_hyper_cube() && !cells.all_reference_cells_are_simplex())
        throw UserError("the mesh mixes shapes of cells: use quadrilaterals or hexahedra only, or "
                        "triangles or tetrahedra only");
      return cells.all_reference_cells_are_simplex();
    }

    template <int dim>
    dealii::FESystem<dim> make_element(const bool simplicial, const unsigned int degree)
    {
      if (degree < 1 || degree > 2)
        throw UserError("elements of a solid have degree 1 or 2, not " + std::to_string(degree));
      if (simplicial)
        return dealii::FESystem<dim>(dealii::FE_SimplexP<dim>(degree), dim);
      return dealii::FESystem<dim>(dealii::FE_Q<dim>(degree), dim);
    }

    template <int dim>
    std::unique_ptr<dealii::Mapping<dim>> make_mapping(const bool simplicial,
                                                       const unsigned int degree)
    {
      if (simplicial)
        return std::make_unique<dealii::MappingFE<dim>>(dealii::FE_SimplexP<dim>(1));
      return std::make_unique<dealii::MappingQ<dim>>(degree);
    }

  } // namespace

  template <int dim>
  SolidMesh<dim>::SolidMesh(std::unique_ptr<dealii::Triangulation<dim>> given,
                            const unsigned int degree)
      : triangulation(std::move(given)), simplicial(has_simplices(*triangulation)),
        cell_mapping(make_mapping<dim>(simplicial, degree)),
        element(make_element<dim>(simplicial, degree)), handler(*triangulation)
  {
    handler.distribute_dofs(element);
    support_points.resize(handler.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(*cell_mapping, handler, support_points);
    components.resize(handler.n_dofs());
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    for (const auto &cell : handler.active_cell_iterators())
    {
      active_cells.push_back(cell);
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        components[dofs[i]] = element.system_to_component_index(i).first;
    }
    boundary = surface({});
  }

  template <int dim>
  dealii::Quadrature<dim> SolidMesh<dim>::quadrature(const unsigned int n_points) const
  {
    if (simplicial)
      return dealii::QGaussSimplex<dim>(n_points);
    return dealii::QGauss<dim>(n_points);
  }

  template <int dim>
  dealii::Quadrature<dim - 1> SolidMesh<dim>::face_quadrature(const unsigned int n_points) const
  {
    if (simplicial)
      return dealii::QGaussSimplex<dim - 1>(n_points);
    return dealii::QGauss<dim - 1>(n_points);
  }

  template <int dim>
  std::set<dealii::types::boundary_id> SolidMesh<dim>::boundary_ids() const
  {
    const std::vector<dealii::types::boundary_id> ids = triangulation->get_boundary_ids();
    return {ids.begin(), ids.end()};
  }

  template <int dim>
  std::string SolidMesh<dim>::no_boundary(const dealii::types::boundary_id id) const
  {
    std::string text = "the mesh has no boundary " + std::to_string(id) + "; it has";
    for (const auto known : boundary_ids())
      text += " " + std::to_string(known);
    return text;
  }

  template <int dim>
  typename SolidMesh<dim>::Surface
  SolidMesh<dim>::surface(const std::set<dealii::types::boundary_id> &boundaries) const
  {
    const std::set<dealii::types::boundary_id> ids = boundary_ids();
    for (const auto id : boundaries)
      if (ids.count(id) == 0)
        throw UserError(no_boundary(id));
    Surface result;
    result.surface.dim = dim;
    result.surface.degree = degree();
    const unsigned int n_per_face = element.n_dofs_per_face(0) / dim;
    // Nodes of an edge: its ends, then its middle; of a quadrilateral in lexicographic order; of a
    // triangle its corners, then the middles of its edges.
    std::vector<unsigned int> order(n_per_face);
    for (unsigned int i = 0; i < n_per_face; ++i)
      order[i] = i;
    if (dim == 3 && !simplicial)
      order = dealii::FETools::hierarchic_to_lexicographic_numbering<dim - 1>(degree());
    std::map<dealii::types::global_dof_index, unsigned int> node_of; // by the DoF along x
    dealii::FEFaceValues<dim> values(*cell_mapping, element, face_quadrature(1),
                                     dealii::update_normal_vectors);
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_face(0));
    for (const auto &cell : handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary())
          continue;
        cell->face(f)->get_dof_indices(dofs);
        std::vector<std::array<dealii::types::global_dof_index, dim>> nodes(n_per_face);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto [c, index] = element.face_system_to_component_index(i, f);
          nodes[index][c] = dofs[i];
        }
        std::vector<unsigned int> face(n_per_face);
        for (unsigned int i = 0; i < n_per_face; ++i)
        {
          const auto [known, is_new] =
              node_of.insert({nodes[i][0], static_cast<unsigned int>(result.dofs.size())});
          if (is_new)
          {
            result.dofs.push_back(nodes[i]);
            result.surface.points.push_back(coordinates<dim>(support_points[nodes[i][0]]));
          }
          face[order[i]] = known->second;
        }
        if (!boundaries.empty() && boundaries.count(cell->face(f)->boundary_id()) == 0)
          continue;
        result.surface.faces.push_back(std::move(face));
        values.reinit(cell, f);
        result.surface.outward.push_back(coordinates<dim>(values.normal_vector(0)));
      }
    dealii::AffineConstraints<double> constraints;
    dealii::DoFTools::make_hanging_node_constraints(handler, constraints);
    for (const auto &[dof, node] : node_of)
      if (const auto *entries = constraints.get_constraint_entries(dof); entries != nullptr)
      {
        result.surface.hanging.push_back({node, {}});
        for (const auto &[parent, weight] : *entries)
          result.surface.hanging.back().parents.emplace_back(node_of.at(parent), weight);
      }
    return result;
  }

  template class SolidMesh<2>;
  template class SolidMesh<3>;
} // namespace taut
