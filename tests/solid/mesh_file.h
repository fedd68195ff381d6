// SPDX-License-Identifier: LGPL-2.1-or-later
// A mesh that a test writes for one scene.
#ifndef taut_tests_mesh_file_h
#define taut_tests_mesh_file_h

#include "common.h"

#include <deal.II/grid/tria.h>

namespace verification
{
  /// A file in gmsh's format 2.2. Nodes count from 1 as they are added.
  class MeshFile
  {
  public:
    static constexpr int line = 1, triangle = 2, quadrilateral = 3, tetrahedron = 4, hexahedron = 5;

    MeshFile() { nodes.precision(17); }

    /// Of a triangulation, whose boundary ids become larger by @p first_id.
    template <int dim>
    explicit MeshFile(const dealii::Triangulation<dim> &cells, const int first_id = 0) : MeshFile()
    {
      for (const dealii::Point<dim> &x : cells.get_vertices())
        add_node(x[0], x[1], x[dim - 1] * (dim - 2));
      const auto add_object = [this](const int type, const int id, const auto &object)
      {
        std::vector<std::size_t> corners;
        const bool is_turned = type == quadrilateral || type == hexahedron;
        for (const unsigned int v : object->vertex_indices())
          corners.push_back(1 + object->vertex_index(is_turned && v % 4 >= 2 ? v ^ 1u : v));
        add(type, id, corners);
      };
      const bool has_boxes = cells.all_reference_cells_are_hyper_cube();
      for (const auto &cell : cells.active_cell_iterators())
      {
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            add_object(dim == 2    ? line
                       : has_boxes ? quadrilateral
                                   : triangle,
                       first_id + cell->face(f)->boundary_id(), cell->face(f));
        add_object(dim == 2 ? (has_boxes ? quadrilateral : triangle)
                            : (has_boxes ? hexahedron : tetrahedron),
                   cell->material_id(), cell);
      }
    }

    void add_node(const double x, const double y, const double z = 0.)
    {
      nodes << ++n_nodes << ' ' << x << ' ' << y << ' ' << z << '\n';
    }

    /// @p id is the boundary of a side, or the material of a cell.
    void add(const int type, const int id, const std::vector<std::size_t> &corners)
    {
      elements << ++n_elements << ' ' << type << " 2 " << id << ' ' << id;
      for (const std::size_t corner : corners)
        elements << ' ' << corner;
      elements << '\n';
    }

    std::string path() const
    {
      return folder.write(folder.path.filename().string() + ".msh",
                          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" +
                              std::to_string(n_nodes) + "\n" + nodes.str() +
                              "$EndNodes\n$Elements\n" + std::to_string(n_elements) + "\n" +
                              elements.str() + "$EndElements\n");
    }

  private:
    Folder folder;
    std::size_t n_nodes = 0, n_elements = 0;
    std::ostringstream nodes, elements;
  };
} // namespace verification

#endif
