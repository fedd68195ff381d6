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
   * A mesh with displacements of degree 1 or 2 on it: quadrilaterals and hexahedra with hanging
   * nodes, or triangles and tetrahedra.
   */
  template <int dim>
  class SolidMesh
  {
  public:
    /// Throws UserError for a mesh without cells or of mixed shapes, and for another degree.
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

    /// A message that it does not have this one.
    std::string no_boundary(dealii::types::boundary_id id) const;

    /// Where each DoF is [m], and along which axis it moves.
    const std::vector<dealii::Point<dim>> &points() const { return support_points; }
    unsigned int component(dealii::types::global_dof_index dof) const { return components[dof]; }

    /// The boundary for contact, and the DoFs of its nodes: nodes of the whole boundary, faces of
    /// the parts with these ids, of all if there are none. Throws UserError for an id that the mesh
    /// does not have.
    struct Surface
    {
      ContactSurface surface;
      std::vector<std::array<dealii::types::global_dof_index, dim>> dofs; ///< of each node
    };
    Surface surface(const std::set<dealii::types::boundary_id> &boundaries) const;

    /// The same of the whole boundary.
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
