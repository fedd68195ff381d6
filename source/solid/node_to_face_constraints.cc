// SPDX-License-Identifier: LGPL-2.1-or-later
#include "closest_point.h"
#include "face_search.h"
#include "nodal_areas.h"
#include <taut/base/exceptions.h>
#include <taut/solid/contact_constraints.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace taut
{
  namespace
  {
    /// Smallest cosine between the normal of a slave face and the opposite normal of a master face
    /// for which the faces face each other.
    constexpr double facing = .1;

    /// Largest difference of this cosine between the nodes of a face.
    constexpr double margin = .5;

    /// Largest distance of a node beside the master, over the distance plus the size of the face.
    constexpr double beside = 1e-6;

    /// Distance over the size of a face below which its direction is rounding.
    constexpr double no_distance = 1e-9;

    /// Projects nodes of one surface onto another.
    class Projection
    {
    public:
      Projection(const SurfaceGeometry &slave, const SurfaceGeometry &master, const double distance)
          : slave(slave), master(master), areas(slave), normals(master), points(master),
            search(master), distance(distance)
      {
      }

      /// Sets the part of the faces of a node that has nodes without a constraint: the area of the
      /// node counts these faces completely.
      void find_overhang(const std::vector<char> &is_constrained, SurfaceConstraint &c) const
      {
        for (const std::size_t face : areas.faces_along(c.node, c.normal))
        {
          const std::vector<unsigned int> &nodes = slave.nodes(face);
          double n_free = 0.;
          for (const unsigned int node : nodes)
            n_free += !is_constrained[node];
          c.uncovered = std::max(c.uncovered, n_free / nodes.size());
        }
      }

      /// The constraint of a node; none if it does not face the master.
      std::optional<SurfaceConstraint> constraint(const unsigned int node) const
      {
        if (areas.faces(node).empty())
          return std::nullopt;
        const Coordinates x = slave.point(node);
        const std::optional<ClosestPoint> found = closest(node, x);
        if (!found)
          return std::nullopt;
        const FacePoint p = master.at(found->face, found->reference);
        const Coordinates d = x - p.position;
        const double size = master.box(found->face).diagonal(),
                     across = norm(add_scaled(d, -dot(d, p.normal()), p.normal()));
        if (found->on_open_border && across > beside * (found->distance + size))
          return std::nullopt;
        const Coordinates normal = normal_at(*found, p, d);
        SurfaceConstraint c;
        c.node = node;
        c.point = x;
        c.normal = scaled(-1., normal);
        c.gap = dot(d, normal);
        c.area = areas.area(node, c.normal);
        c.slave = {{node, normal}};
        for (unsigned int k = 0; k < p.shapes.n; ++k)
          if (p.shapes.value[k] != 0.)
            c.master.push_back({master.nodes(found->face)[k], scaled(-p.shapes.value[k], normal)});
        return c;
      }

    private:
      /// The normal of a constraint, out of the master: the normal of the face, or at an edge or
      /// corner of the face the direction @p d to the node.
      Coordinates normal_at(const ClosestPoint &found, const FacePoint &p,
                            const Coordinates &d) const
      {
        const Coordinates normal = p.normal();
        if (!found.on_border || found.distance <= no_distance * master.box(found.face).diagonal())
          return normal;
        return scaled((dot(d, normal) < 0. ? -1. : 1.) / norm(d), d);
      }

      /// True if the node faces a face with this normal out of the master.
      bool faces(const unsigned int node, const Coordinates &normal) const
      {
        return areas.largest_cosine(node, scaled(-1., normal)) >= facing;
      }

      /// The closest point of faces that the node faces, and has not penetrated by more than an
      /// element.
      std::optional<ClosestPoint> closest(const unsigned int node, const Coordinates &x) const
      {
        std::optional<ClosestPoint> best;
        double own_size = 0.;
        for (const NodalAreas::NodeOfFace &f : areas.faces(node))
          own_size = std::max(own_size, slave.box(f.face).diagonal());
        const auto visit = [&](const std::size_t face, const double box_distance)
        {
          if (box_distance > (best ? best->distance : distance))
            return false;
          if (!may_face(node, face))
            return true;
          const ClosestPoint found = points.find(face, x);
          if (found.distance > distance || (best && found.distance >= best->distance))
            return true;
          const FacePoint p = master.at(face, found.reference);
          const bool is_deep = dot(x - p.position, p.area) < 0. &&
                               found.distance > std::max(own_size, master.box(face).diagonal());
          if (!is_deep && faces(node, p.normal()) &&
              faces(node, normal_at(found, p, x - p.position)))
            best = found;
          return true;
        };
        search.visit_nearest(x, visit);
        return best;
      }

      /// True if a place of the face may face the node, from normals at nodes.
      bool may_face(const unsigned int node, const std::size_t face) const
      {
        for (std::size_t i = 0; i < master.nodes(face).size(); ++i)
          if (areas.largest_cosine(node, scaled(-1., normals.at(face, i))) >= facing - margin)
            return true;
        return false;
      }

      const SurfaceGeometry &slave, &master;
      const NodalAreas areas;
      const NodeNormals normals; ///< of the master
      const ClosestPoints points;
      const FaceSearch search;
      const double distance;
    };

    std::vector<SurfaceConstraint> constrain_nodes(const ContactSurface &slave,
                                                   const ContactSurface &master,
                                                   const unsigned int dim, const double thickness,
                                                   const double wanted_distance)
    {
      const SurfaceGeometry slaves(slave), masters(master);
      check_dimensions(slave, master);
      if (slave.dim != dim)
        throw UserError("contact surfaces '" + slave.name + "' and '" + master.name + "': " +
                        (dim == 2 ? "node-to-segment constraints are for the plane; in space take "
                                    "node-to-face"
                                  : "node-to-face constraints are for bodies in space; in the "
                                    "plane take mortar or node-to-segment"));
      check_thickness(thickness);
      const double distance = search_distance(slaves, masters, wanted_distance);
      const Projection projection(slaves, masters, distance);
      std::vector<SurfaceConstraint> constraints;
      for (unsigned int node = 0; node < slave.points.size(); ++node)
        if (std::optional<SurfaceConstraint> c = projection.constraint(node))
        {
          c->area *= thickness;
          constraints.push_back(std::move(*c));
        }
      std::vector<char> is_constrained(slave.points.size(), 0);
      for (const SurfaceConstraint &c : constraints)
        is_constrained[c.node] = 1;
      for (SurfaceConstraint &c : constraints)
        projection.find_overhang(is_constrained, c);
      if (constraints.empty())
        complain_about_search(slaves, masters, distance);
      return constraints;
    }
  } // namespace

  std::vector<SurfaceConstraint> node_to_segment_constraints(const ContactSurface &slave,
                                                             const ContactSurface &master,
                                                             const double thickness,
                                                             const double search_distance)
  {
    return constrain_nodes(slave, master, 2, thickness, search_distance);
  }

  std::vector<SurfaceConstraint> node_to_face_constraints(const ContactSurface &slave,
                                                          const ContactSurface &master,
                                                          const double search_distance)
  {
    return constrain_nodes(slave, master, 3, 1., search_distance);
  }
} // namespace taut
