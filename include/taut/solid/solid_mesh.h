// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solid_mesh_h
#define taut_solid_mesh_h

#include <taut/base/coordinates.h>
#include <taut/scene/contact_surface.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace taut
{
  /// A point [m] or direction [1] of deal.II; in the plane z = 0.
  template <int dim>
  Coordinates coordinates(const dealii::Tensor<1, dim> &x)
  {
    return {x[0], x[1], dim == 3 ? x[dim - 1] : 0.};
  }

  /**
   * The mesh of an ElasticSolid, with displacements of degree 1 or 2: quadrilaterals and hexahedra
   * with hanging nodes, or triangles and tetrahedra. Make it from any triangulation of deal.II.
   */
  template <int dim>
  class SolidMesh
  {
  public:
    /// Throws UserError for a mesh without cells, a mesh of mixed shapes, and another degree.
    SolidMesh(std::unique_ptr<dealii::Triangulation<dim>> triangulation, unsigned int degree);

    const dealii::DoFHandler<dim> &dof_handler() const { return handler; }
    const dealii::Mapping<dim> &mapping() const { return *cell_mapping; }
    unsigned int degree() const { return element.degree; }
    bool is_simplicial() const { return simplicial; }

    /// Gauss points that integrate products of @p n_points - 1 degrees in each direction exactly,
    /// on cells and on their faces.
    dealii::Quadrature<dim> quadrature(unsigned int n_points) const;
    dealii::Quadrature<dim - 1> face_quadrature(unsigned int n_points) const;

    /// Ids of the parts of the boundary that the mesh has.
    std::set<dealii::types::boundary_id> boundary_ids() const;

    /// A message that the mesh does not have this boundary.
    std::string no_boundary(dealii::types::boundary_id id) const;

    /// Position of each DoF [m]; component() is the axis along which it moves.
    const std::vector<dealii::Point<dim>> &points() const { return support_points; }
    unsigned int component(dealii::types::global_dof_index dof) const { return components[dof]; }

    /// The contact surface of the mesh, and the DoFs of its nodes. It has the nodes of the whole
    /// boundary, and the faces of the parts with these ids, or all faces without ids. Throws
    /// UserError for an id that the mesh does not have.
    struct Surface
    {
      ContactSurface surface;
      std::vector<std::array<dealii::types::global_dof_index, dim>> dofs; ///< of each node
    };
    Surface surface(const std::set<dealii::types::boundary_id> &boundaries) const;

    /// The contact surface of the whole boundary.
    const Surface &whole_surface() const { return boundary; }

    /// All active cells, by their number.
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    const std::vector<Cell> &cells() const { return active_cells; }

  private:
    std::unique_ptr<dealii::Triangulation<dim>> triangulation;
    bool simplicial;
    std::unique_ptr<dealii::Mapping<dim>> cell_mapping;
    dealii::FESystem<dim> element;
    dealii::DoFHandler<dim> handler;
    std::vector<dealii::Point<dim>> support_points;
    std::vector<unsigned char> components;
    std::vector<Cell> active_cells;
    Surface boundary;
  };
} // namespace taut

#endif
