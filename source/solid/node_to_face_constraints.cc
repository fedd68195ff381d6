// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/closest_point.h"
#include "solid/face_search.h"
#include "solid/nodal_areas.h"
#include "solid/overlap.h"
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
    /// Largest difference of this cosine between the nodes of a face.
    constexpr double margin = .5;

    /// Largest distance of a node beside the master, over the distance plus the size of the face.
    /// The pressure on the face changes by as much.
    constexpr double beside = 1e-4;

    /// Distance of such a node beside the master, over its distance from it, by which the direction
    /// between them is not the normal.
    constexpr double no_normal = 1e-6;

    /// Distance over the size of a face below which its direction is rounding.
    constexpr double no_distance = 1e-9;

    /// Part of the weights of a face by which a point is beside its nodes.
    constexpr double at_node = 1e-6;

    /// Projects nodes of one surface onto another.
    class Projection
    {
    public:
      Projection(const SurfaceGeometry &slave, const SurfaceGeometry &master, const double distance,
                 const WholeBoundaries &boundaries)
          : slave(slave), master(master), areas(slave), normals(master), points(master),
            search(master), overlap(slave, master, boundaries), distance(distance)
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
        if (found->on_open_border && is_beside(*found, across(p, d)))
          return std::nullopt;
        const Coordinates normal = normal_at(*found, p, d);
        SurfaceConstraint c;
        c.node = node;
        c.point = x;
        c.normal = scaled(-1., normal);
        c.gap = dot(d, normal);
        c.slave = {{node, normal}};
        for (unsigned int k = 0; k < p.shapes.n; ++k)
          if (p.shapes.value[k] != 0.)
            c.master.push_back({master.nodes(found->face)[k], scaled(-p.shapes.value[k], normal)});
        return c;
      }

      /// Throws UserError for a node without a constraint that is in the master too deeply.
      void check_overlap(const unsigned int node, const bool no_contact) const
      {
        if (!areas.faces(node).empty())
          overlap.check(
              slave.point(node), [&](const Coordinates &normal) { return faces(node, normal); },
              no_contact);
      }

      /// Length of the smallest face of a node [m].
      double element(const unsigned int node) const
      {
        double smallest = std::numeric_limits<double>::infinity();
        for (const NodalAreas::NodeOfFace &f : areas.faces(node))
          smallest = std::min(smallest, slave.box(f.face).diagonal());
        return smallest / (slave.surface().dim == 2 ? 1. : std::sqrt(2.));
      }

      /// Area of the node of a constraint.
      double area(const SurfaceConstraint &c) const { return areas.area(c.node, c.normal); }

    private:
      /// Distance of a node from the normal line of a place of the master.
      static double across(const FacePoint &p, const Coordinates &d)
      {
        return norm(add_scaled(d, -dot(d, p.normal()), p.normal()));
      }

      bool is_beside(const ClosestPoint &found, const double across) const
      {
        return across > beside * (found.distance + master.box(found.face).diagonal());
      }

      /// The normal of a constraint, out of the master: the normal of the face, or at an edge or
      /// corner of the face the direction @p d to the node. A node that is a little beside the
      /// master has the normal of the face.
      Coordinates normal_at(const ClosestPoint &found, const FacePoint &p,
                            const Coordinates &d) const
      {
        const Coordinates normal = p.normal();
        if (!found.on_border || found.distance <= no_distance * master.box(found.face).diagonal())
          return normal;
        if (const double by = across(p, d);
            found.on_open_border && by > no_normal * found.distance && !is_beside(found, by))
          return normal;
        return scaled((dot(d, normal) < 0. ? -1. : 1.) / norm(d), d);
      }

      /// True if the node faces a face with this normal out of the master.
      bool faces(const unsigned int node, const Coordinates &normal) const
      {
        return areas.largest_cosine(node, scaled(-1., normal)) >= facing;
      }

      /// The closest point of faces that the node faces, in front or through an overlap that is
      /// closed.
      std::optional<ClosestPoint> closest(const unsigned int node, const Coordinates &x) const
      {
        const double farthest = std::max(distance, overlap.reach());
        std::optional<ClosestPoint> best;
        double too_deep = std::numeric_limits<double>::infinity(); // faces farther behind are, too
        const auto visit = [&](const std::size_t face, const double box_distance)
        {
          if (box_distance > (best ? best->distance : farthest))
            return false;
          if (!may_face(node, face))
            return true;
          const ClosestPoint found = points.find(face, x);
          if (best && found.distance >= best->distance)
            return true;
          const FacePoint p = master.at(face, found.reference);
          const bool is_behind = dot(x - p.position, p.area) < 0.;
          if (found.distance > (is_behind ? too_deep : distance) || !faces(node, p.normal()) ||
              !faces(node, normal_at(found, p, x - p.position)))
            return true;
          if (is_behind && !overlap.is_closed(x, p.position))
            too_deep = found.distance;
          else
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
      const Overlap overlap;
      const double distance;
    };

    std::vector<SurfaceConstraint> constrain_nodes(const ContactSurface &slave,
                                                   const ContactSurface &master,
                                                   const unsigned int dim, const double thickness,
                                                   const double wanted_distance,
                                                   const WholeBoundaries &boundaries)
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
      const Projection projection(slaves, masters, distance, boundaries);
      std::vector<SurfaceConstraint> constraints;
      for (unsigned int node = 0; node < slave.points.size(); ++node)
        if (std::optional<SurfaceConstraint> c = projection.constraint(node))
        {
          c->area = projection.area(*c) * thickness;
          constraints.push_back(std::move(*c));
        }
        else
          projection.check_overlap(node, false);
      std::vector<char> is_constrained(slave.points.size(), 0);
      for (const SurfaceConstraint &c : constraints)
        is_constrained[c.node] = 1;
      for (SurfaceConstraint &c : constraints)
        projection.find_overhang(is_constrained, c);
      for (unsigned int node = 0; constraints.empty() && node < slave.points.size(); ++node)
        projection.check_overlap(node, true);
      if (constraints.empty() && !inner_points(slave, master, wanted_distance, boundaries).empty())
        throw UserError("contact surfaces '" + slave.name + "' and '" + master.name +
                        "': the second lies between nodes of the first, and no node of the first "
                        "is on it. Exchange Slave and Master, or make the faces of the first "
                        "smaller");
      if (constraints.empty())
        complain_about_search(slaves, masters, distance);
      return constraints;
    }
  } // namespace

  std::vector<InnerPoint> inner_points(const ContactSurface &slave, const ContactSurface &master,
                                       const double wanted_distance,
                                       const WholeBoundaries &boundaries)
  {
    const SurfaceGeometry slaves(slave), masters(master);
    const Projection projection(masters, slaves, search_distance(slaves, masters, wanted_distance),
                                {boundaries.master, boundaries.slave});
    std::vector<InnerPoint> result;
    for (unsigned int node = 0; node < master.points.size(); ++node)
    {
      std::optional<SurfaceConstraint> c = projection.constraint(node);
      if (!c || std::any_of(c->master.begin(), c->master.end(),
                            [](const NodeWeight &w) { return norm(w.weight) > 1. - at_node; }))
        continue;
      std::swap(c->slave, c->master);
      c->normal = scaled(-1., c->normal);
      InnerPoint p;
      Box box{c->point, c->point};
      for (const NodeWeight &w : c->slave)
        box.add(slaves.point(w.node));
      p.face = box.diagonal() / (c->slave.size() > 2 && slave.dim == 3 ? std::sqrt(2.) : 1.);
      p.needed_face = std::min(projection.element(node), .5 * p.face);
      p.constraint = std::move(*c);
      result.push_back(std::move(p));
    }
    return result;
  }

  std::vector<SurfaceConstraint> node_to_segment_constraints(const ContactSurface &slave,
                                                             const ContactSurface &master,
                                                             const double thickness,
                                                             const double search_distance,
                                                             const WholeBoundaries &boundaries)
  {
    return constrain_nodes(slave, master, 2, thickness, search_distance, boundaries);
  }

  std::vector<SurfaceConstraint> node_to_face_constraints(const ContactSurface &slave,
                                                          const ContactSurface &master,
                                                          const double search_distance,
                                                          const WholeBoundaries &boundaries)
  {
    return constrain_nodes(slave, master, 3, 1., search_distance, boundaries);
  }
} // namespace taut
