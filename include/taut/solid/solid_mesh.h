// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solid_mesh_h
#define taut_solid_mesh_h

#include <taut/base/communicator.h>
#include <taut/base/coordinates.h>
#include <taut/scene/contact_surface.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/quadrature.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
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
   * with hanging nodes, or triangles and tetrahedra. Make it from any triangulation of deal.II. Of
   * a distributed one each rank has its own cells, and all ranks have the boundary; all ranks make
   * the mesh together.
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
    const std::set<dealii::types::boundary_id> &boundary_ids() const { return ids_of_boundary; }

    /// A message that the mesh does not have this boundary.
    std::string no_boundary(dealii::types::boundary_id id) const;

    /// Position of a DoF on a cell of this rank or beside it [m]; component() is the axis along
    /// which it moves.
    const dealii::Point<dim> &point(const dealii::types::global_dof_index dof) const
    {
      return support_points[index(dof)];
    }
    unsigned int component(const dealii::types::global_dof_index dof) const
    {
      return components[index(dof)];
    }

    /// The diagonal of the box around the mesh [m].
    double size() const;

    /// The ranks over which the cells are distributed; one process: this rank has all.
    const Communicator &processes() const { return ranks; }

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

    /// The locally owned active cells, in their order.
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    const std::vector<Cell> &cells() const { return own_cells; }

    /// The DoFs that a hanging DoF depends on, with weights.
    using Parents = std::vector<std::pair<unsigned int, double>>;

  private:
    /// A face of the boundary as ranks send it to each other.
    struct Face;

    std::size_t index(const dealii::types::global_dof_index dof) const
    {
      return relevant.size() == 0 ? dof : relevant.index_within_set(dof);
    }
    void find_points();
    std::vector<Face> own_faces() const;
    void share(std::vector<Face> &faces, std::map<unsigned int, Parents> &hanging) const;
    void find_boundary();

    std::unique_ptr<dealii::Triangulation<dim>> triangulation;
    const Communicator ranks;
    bool simplicial;
    std::unique_ptr<dealii::Mapping<dim>> cell_mapping;
    dealii::FESystem<dim> element;
    dealii::DoFHandler<dim> handler;
    dealii::IndexSet relevant; ///< DoFs on cells of this rank and beside them; empty: all
    std::vector<dealii::Point<dim>> support_points;
    std::vector<unsigned char> components;
    std::vector<Cell> own_cells;
    Surface boundary;
    std::vector<dealii::types::boundary_id> id_of_face; ///< of each face of the boundary
    std::set<dealii::types::boundary_id> ids_of_boundary;
  };
} // namespace taut

#endif
