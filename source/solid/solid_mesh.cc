// SPDX-License-Identifier: LGPL-2.1-or-later
#include "substructure/distributed_mesh.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/solid/solid_mesh.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>

#include <deal.II/grid/cell_id.h>

#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <tuple>

namespace taut
{
  namespace
  {
    template <int dim>
    bool has_simplices(const dealii::Triangulation<dim> &cells)
    {
      if (cells.n_global_active_cells() == 0)
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
      : triangulation(std::move(given)), ranks(processes_of(*triangulation)),
        simplicial(has_simplices(*triangulation)),
        cell_mapping(make_mapping<dim>(simplicial, degree)),
        element(make_element<dim>(simplicial, degree)), handler(*triangulation)
  {
    handler.distribute_dofs(element);
    own_cells = own_cells_of(handler);
    find_points();
    find_boundary();
  }

  template <int dim>
  void SolidMesh<dim>::find_points()
  {
    if (ranks.size() > 1)
      relevant = relevant_dofs(handler);
    support_points.resize(ranks.size() > 1 ? relevant.n_elements() : handler.n_dofs());
    components.resize(support_points.size());
    dealii::FEValues<dim> values(*cell_mapping, element,
                                 dealii::Quadrature<dim>(element.get_unit_support_points()),
                                 dealii::update_quadrature_points);
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    for (const auto &cell : handler.active_cell_iterators())
    {
      if (cell->is_artificial())
        continue;
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const std::size_t at = index(dofs[i]);
        components[at] = element.system_to_component_index(i).first;
        support_points[at] = values.quadrature_point(i);
      }
    }
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
  std::string SolidMesh<dim>::no_boundary(const dealii::types::boundary_id id) const
  {
    std::string text = "the mesh has no boundary " + std::to_string(id) + "; it has";
    for (const auto known : boundary_ids())
      text += " " + std::to_string(known);
    return text;
  }

  template <int dim>
  double SolidMesh<dim>::size() const
  {
    Coordinates lower = boundary.surface.points.front(), upper = lower;
    for (const Coordinates &x : boundary.surface.points)
    {
      lower = {std::min(lower.x, x.x), std::min(lower.y, x.y), std::min(lower.z, x.z)};
      upper = {std::max(upper.x, x.x), std::max(upper.y, x.y), std::max(upper.z, x.z)};
    }
    return norm(upper - lower);
  }

  template <int dim>
  struct SolidMesh<dim>::Face
  {
    unsigned int level = 0, number = 0, id = 0; ///< of the cell; on the cell; of the boundary
    std::vector<unsigned int> cell;             ///< its place_in_order()
    std::vector<unsigned int> dofs;             ///< of the nodes, in the order of ContactSurface
    std::vector<Coordinates> points;
    Coordinates outward;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &level &number &id &cell &dofs;
      points.resize(dofs.size() / dim);
      for (Coordinates &x : points)
        archive &x.x &x.y &x.z;
      archive &outward.x &outward.y &outward.z;
    }
  };

  namespace
  {
    /// Number of the coarse cell that has the cell, and numbers of children down to it: the same
    /// on any number of ranks.
    template <typename Cell, int dim = Cell::AccessorType::dimension>
    std::vector<unsigned int> place_in_order(const Cell &cell)
    {
      const dealii::CellId id = cell->id();
      auto coarse = static_cast<unsigned int>(id.get_coarse_cell_id());
      // There ids are those of the trees of p4est, and all ranks have all coarse cells.
      if (dynamic_cast<const dealii::parallel::distributed::Triangulation<dim> *>(
              &cell->get_triangulation()))
      {
        typename dealii::Triangulation<dim>::cell_iterator top = cell;
        while (top->level() > 0)
          top = top->parent();
        coarse = top->index();
      }
      std::vector<unsigned int> result = {coarse};
      for (const auto child : id.get_child_indices())
        result.push_back(child);
      return result;
    }
  } // namespace

  /// The faces of the boundary on the cells of this rank.
  template <int dim>
  std::vector<typename SolidMesh<dim>::Face> SolidMesh<dim>::own_faces() const
  {
    const unsigned int n_per_face = element.n_dofs_per_face(0) / dim;
    // Nodes of an edge: its ends, then its middle; of a quadrilateral in lexicographic order; of a
    // triangle its corners, then the middles of its edges.
    std::vector<unsigned int> order(n_per_face);
    for (unsigned int i = 0; i < n_per_face; ++i)
      order[i] = i;
    if (dim == 3 && !simplicial)
      order = dealii::FETools::hierarchic_to_lexicographic_numbering<dim - 1>(degree());
    dealii::FEFaceValues<dim> values(*cell_mapping, element, face_quadrature(1),
                                     dealii::update_normal_vectors);
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_face(0));
    std::vector<Face> result;
    for (const Cell &cell : own_cells)
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary())
          continue;
        cell->face(f)->get_dof_indices(dofs);
        Face face;
        face.number = f;
        face.id = cell->face(f)->boundary_id();
        face.dofs.resize(dofs.size());
        face.points.resize(n_per_face);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto [c, node] = element.face_system_to_component_index(i, f);
          face.dofs[dim * order[node] + c] = dofs[i];
          face.points[order[node]] = coordinates<dim>(point(dofs[i]));
        }
        values.reinit(cell, f);
        face.outward = coordinates<dim>(values.normal_vector(0));
        face.level = cell->level();
        face.cell = place_in_order(cell);
        result.push_back(std::move(face));
      }
    return result;
  }

  /// The faces of all ranks, and their hanging nodes.
  template <int dim>
  void SolidMesh<dim>::share(std::vector<Face> &faces,
                             std::map<unsigned int, Parents> &hanging) const
  {
    const std::vector<std::string> all =
        ranks.gather(archived([&](OutputArchive &archive) { archive << faces << hanging; }));
    faces.clear();
    for (const std::string &text : all)
    {
      std::vector<Face> of_rank;
      std::map<unsigned int, Parents> hanging_of_rank;
      unarchive(text, [&](InputArchive &archive) { archive >> of_rank >> hanging_of_rank; });
      faces.insert(faces.end(), of_rank.begin(), of_rank.end());
      hanging.insert(hanging_of_rank.begin(), hanging_of_rank.end());
    }
  }

  template <int dim>
  void SolidMesh<dim>::find_boundary()
  {
    std::vector<Face> faces = own_faces();
    const dealii::AffineConstraints<double> constraints = hanging_nodes(handler);
    std::map<unsigned int, Parents> hanging; // by the DoF along x
    for (const Face &face : faces)
      for (std::size_t i = 0; i < face.dofs.size(); i += dim)
        if (const auto *entries = constraints.get_constraint_entries(face.dofs[i]))
          hanging[face.dofs[i]].assign(entries->begin(), entries->end());
    if (ranks.size() > 1)
      share(faces, hanging);
    // The same order on any number of ranks.
    std::sort(faces.begin(), faces.end(),
              [](const Face &a, const Face &b) {
                return std::tie(a.level, a.cell, a.number) < std::tie(b.level, b.cell, b.number);
              });

    boundary.surface.dim = dim;
    boundary.surface.degree = degree();
    std::map<unsigned int, unsigned int> node_of; // by the DoF along x
    for (const Face &face : faces)
    {
      boundary.surface.faces.emplace_back();
      for (std::size_t i = 0; i < face.points.size(); ++i)
      {
        const auto dofs = face.dofs.begin() + static_cast<std::ptrdiff_t>(dim * i);
        const auto [known, is_new] =
            node_of.insert({*dofs, static_cast<unsigned int>(boundary.dofs.size())});
        if (is_new)
        {
          boundary.dofs.emplace_back();
          std::copy(dofs, dofs + dim, boundary.dofs.back().begin());
          boundary.surface.points.push_back(face.points[i]);
        }
        boundary.surface.faces.back().push_back(known->second);
      }
      boundary.surface.outward.push_back(face.outward);
      id_of_face.push_back(face.id);
      ids_of_boundary.insert(face.id);
    }
    for (const auto &[dof, parents] : hanging)
    {
      boundary.surface.hanging.push_back({node_of.at(dof), {}});
      for (const auto &[parent, weight] : parents)
        boundary.surface.hanging.back().parents.emplace_back(node_of.at(parent), weight);
    }
  }

  template <int dim>
  typename SolidMesh<dim>::Surface
  SolidMesh<dim>::surface(const std::set<dealii::types::boundary_id> &boundaries) const
  {
    for (const auto id : boundaries)
      if (ids_of_boundary.count(id) == 0)
        throw UserError(no_boundary(id));
    Surface result = boundary;
    if (boundaries.empty())
      return result;
    result.surface.faces.clear();
    result.surface.outward.clear();
    for (std::size_t f = 0; f < id_of_face.size(); ++f)
      if (boundaries.count(id_of_face[f]) != 0)
      {
        result.surface.faces.push_back(boundary.surface.faces[f]);
        result.surface.outward.push_back(boundary.surface.outward[f]);
      }
    return result;
  }

  template class SolidMesh<2>;
  template class SolidMesh<3>;
} // namespace taut
