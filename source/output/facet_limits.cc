// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/facet_limits.h"
#include "base/text.h"
#include <taut/solid/contact_constraints.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Faces across a contact by their degree: heights of a tenth, pressures that alternate by 5 %.
    constexpr double least_linear = 3.1623, least_quadratic = 16.;

    /// Distance of nodes opposite each other over the length of a face; least weight of a node.
    constexpr double opposite = 1e-6;

    /// Part of the contact from which on it is one of curved faces, not of cut corners.
    constexpr double curved_part = .5;

    /// Part of the contact with nodes opposite each other from which on its meshes match.
    constexpr double matched_part = .5;
  } // namespace

  std::vector<double> element_lengths(const ContactSurface &surface)
  {
    std::vector<double> result(surface.points.size(), 0.);
    for (const std::vector<unsigned int> &face : surface.faces)
    {
      const double length = norm(surface.points[face[1]] - surface.points[face[0]]);
      for (const unsigned int node : face)
        result[node] = std::max(result[node], length * (face.size() == 9 ? 2. : 1.));
    }
    return result;
  }

  FacetLimits::FacetLimits(const ContactGeometry &geometry)
  {
    const ContactSurface &slave = geometry.slave, &master = geometry.master;
    const bool has_master = !master.points.empty();
    if (slave.dim == 1 || (has_master && master.dim == 1))
      return;
    std::vector<double> of_slave(slave.points.size(), 0.), of_master;
    if (slave.degree == 2)
      of_slave = heights_of_arcs(slave);
    if (has_master)
      of_master = heights_of_arcs(master);
    const std::vector<double> slave_faces = element_lengths(slave),
                              master_faces = element_lengths(master);
    double area = 0., opposite_area = 0.;
    for (const SurfaceConstraint &c : geometry.constraints)
    {
      Row row{of_slave[c.node], slave_faces[c.node], std::fabs(c.gap), c.area, c.point};
      row.degree = slave.degree;
      double nearest = std::numeric_limits<double>::infinity();
      for (const NodeWeight &w : c.master)
      {
        if (of_master[w.node] > row.height)
        {
          row.height = of_master[w.node];
          row.face = master_faces[w.node];
          row.degree = master.degree;
        }
        const Coordinates apart = master.points[w.node] - slave.points[c.node];
        if (norm(w.weight) > opposite)
          nearest = std::min(nearest, norm(add_scaled(apart, -dot(apart, c.normal), c.normal)));
      }
      row.is_opposite = nearest < opposite * row.face;
      rows.push_back(row);
      area += row.area;
      opposite_area += row.is_opposite ? row.area : 0.;
    }
    // Faces of meshes that match touch each other. Single nodes do not make a match.
    double highest = 0.;
    for (Row &row : rows)
    {
      if (row.is_opposite && opposite_area > matched_part * area)
        row.height = 0.;
      if (row.height > highest)
        degree = row.degree;
      highest = std::max(highest, row.height);
    }
    if (highest > 0.)
      least = degree == 1 ? least_linear : least_quadratic;
    unloaded = find(nullptr);
  }

  /// Of the loaded rows and their largest gap, or of all rows and their mean gap.
  FacetLimits::Found FacetLimits::find(const double *const forces) const
  {
    double area = 0., curved = 0., height = 0., mean_gap = 0., highest = -1.;
    Found found;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const Row &row = rows[i];
      if (forces && !(forces[i] > 0.))
        continue;
      area += row.area;
      curved += row.height > 0. ? row.area : 0.;
      height += row.height * row.area;
      mean_gap += row.gap * row.area;
      found.gap = std::max(found.gap, row.gap);
      if (row.height > highest)
        found.place = i;
      highest = std::max(highest, row.height);
    }
    if (!forces)
      found.gap = mean_gap / area;
    if (curved > curved_part * area)
      found.faces = std::sqrt(found.gap / (height / area));
    return found;
  }

  void FacetLimits::record(const double *const forces)
  {
    if (least == 0. || std::none_of(forces, forces + rows.size(), [](double N) { return N > 0.; }))
      return;
    if (const Found now = find(forces); !is_loaded || now.faces > loaded.faces)
      loaded = now;
    is_loaded = true;
  }

  std::string FacetLimits::text() const
  {
    const Found &found = is_loaded ? loaded : unloaded;
    const Row &row = rows[found.place];
    const std::string length =
        to_text(std::setprecision(3), row.face * std::max(found.faces, 1e-3) / least, " m");
    if (degree == 1)
      return to_text(std::setprecision(3), "has straight faces on a curve that are ", row.height,
                     " m off it at (", row.place,
                     "), more than a tenth of the gap or interference of ", found.gap,
                     " m: gaps and pressures are those of the faces. Take Degree = 2, with the "
                     "curve in Curved boundaries of a mesh from a file, or faces of at most ",
                     length);
    return to_text(
        std::setprecision(3), "acts at (", row.place, ") on about ", found.faces,
        " straight faces of degree 2 on a curve, fewer than ", least,
        ": pressures alternate. Name the curve in Curved boundaries of the mesh, or take "
        "Degree = 1, or faces of at most ",
        length);
  }
} // namespace taut
