// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/solid_entries.h"

#include "base/text.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/utilities.h>

#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Largest distance of the nodes of a curved boundary from its curve, over the radius: files
    /// have few digits, and a larger distance means another shape.
    constexpr double on_curve = 1e-3;

    /// A circle or sphere about a centre, or a cylinder about an axis.
    template <int dim>
    struct Curve
    {
      dealii::types::boundary_id id = 0;
      bool has_axis = false;
      dealii::Point<dim> point;
      dealii::Tensor<1, dim> axis; ///< a unit vector

      double radius(const dealii::Point<dim> &x) const
      {
        const dealii::Tensor<1, dim> d = x - point;
        return has_axis ? (d - (d * axis) * axis).norm() : d.norm();
      }
    };

    /// "3: sphere, 0, 0, 1".
    template <int dim>
    Curve<dim> parse_curve(const std::string &text, const std::string &entry)
    {
      const EntryError error(entry, "'" + text + "' is not " +
                                        (dim == 2 ? "'id: circle, x, y'"
                                                  : "'id: sphere, x, y, z' or 'id: cylinder, x, y, "
                                                    "z, dx, dy, dz' with a direction"));
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos)
        throw error;
      const std::vector<std::string> parts =
          dealii::Utilities::split_string_list(text.substr(colon + 1));
      Curve<dim> result;
      std::vector<double> numbers;
      try
      {
        const int id =
            dealii::Utilities::string_to_int(dealii::Utilities::trim(text.substr(0, colon)));
        if (id < 0)
          throw error;
        result.id = static_cast<dealii::types::boundary_id>(id);
        for (std::size_t i = 1; i < parts.size(); ++i)
          numbers.push_back(dealii::Utilities::string_to_double(parts[i]));
      }
      catch (const std::exception &)
      {
        throw error;
      }
      const std::string shape = parts.empty() ? "" : parts[0];
      result.has_axis = dim == 3 && shape == "cylinder";
      if ((!result.has_axis && shape != (dim == 2 ? "circle" : "sphere")) ||
          numbers.size() != (result.has_axis ? 2 * dim : dim))
        throw error;
      for (unsigned int d = 0; d < dim; ++d)
      {
        result.point[d] = numbers[d];
        if (result.has_axis)
          result.axis[d] = numbers[dim + d];
      }
      if (result.has_axis && !(result.axis.norm() > 0.))
        throw error;
      if (result.has_axis)
        result.axis /= result.axis.norm();
      return result;
    }

    /// Gives the faces of the boundary the manifold; all of their vertices are on the curve.
    template <int dim>
    void attach(dealii::Triangulation<dim> &cells, const Curve<dim> &curve,
                const std::string &entry)
    {
      double least = std::numeric_limits<double>::infinity(), most = 0.;
      for (const auto &face : cells.active_face_iterators())
        if (face->at_boundary() && face->boundary_id() == curve.id)
          for (const unsigned int v : face->vertex_indices())
          {
            least = std::min(least, curve.radius(face->vertex(v)));
            most = std::max(most, curve.radius(face->vertex(v)));
          }
      const std::string what = "boundary " + std::to_string(curve.id);
      if (most == 0.)
        throw EntryError(entry, "the mesh has no " + what + ", or it has no radius");
      if (most - least > on_curve * most)
      {
        throw EntryError(
            entry, to_text("nodes of ", what, " are ", least, " to ", most,
                           " m away from there, on no one radius; check the place and the id"));
      }
      // Edges in space have ids of their own, which a file does not give.
      const dealii::types::manifold_id id = curve.id;
      for (const auto &face : cells.active_face_iterators())
        if (face->at_boundary() && face->boundary_id() == curve.id)
          face->set_all_manifold_ids(id);
      if constexpr (dim == 3)
        if (curve.has_axis)
        {
          cells.set_manifold(id, dealii::CylindricalManifold<dim>(curve.axis, curve.point));
          return;
        }
      cells.set_manifold(id, dealii::SphericalManifold<dim>(curve.point));
    }
  } // namespace

  template <int dim>
  void MeshEntries::curve(dealii::Triangulation<dim> &cells, const std::string &section) const
  {
    if (curved.empty())
      return;
    const std::string entry = section + "Curved boundaries";
    if (file.empty())
      throw EntryError(entry, "a generated mesh has its curves; leave it empty");
    if (!cells.all_reference_cells_are_hyper_cube())
      throw EntryError(entry, "sides of triangles and tetrahedra are straight; take quadrilaterals "
                              "or hexahedra");
    for (const std::string &text : dealii::Utilities::split_string_list(curved, ';'))
      attach(cells, parse_curve<dim>(text, entry), entry);
  }

  template void MeshEntries::curve<2>(dealii::Triangulation<2> &, const std::string &) const;
  template void MeshEntries::curve<3>(dealii::Triangulation<3> &, const std::string &) const;
} // namespace taut
