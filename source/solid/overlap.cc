// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/overlap.h"
#include "base/text.h"
#include "solid/closest_point.h"
#include "solid/face_search.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace taut
{
  namespace
  {
    /// Part of a line, or of a face, by which places on faces round.
    constexpr double rounding = 1e-6;

    /// Smallest cosine of the direction from a place inside a body to the closest one on its faces,
    /// at an edge of a concave side. Outside, at a sharp edge, it is smaller.
    constexpr double along_normal = .9;

    double half_diagonal(const SurfaceGeometry &geometry)
    {
      Box box{geometry.point(0), geometry.point(0)};
      for (unsigned int node = 0; node < geometry.surface().points.size(); ++node)
        box.add(geometry.point(node));
      return .5 * box.diagonal();
    }
  } // namespace

  struct Overlap::Boundaries
  {
    /// All of the boundary of a body.
    struct Boundary
    {
      explicit Boundary(const ContactSurface &surface)
          : surface(surface), geometry(surface), search(geometry)
      {
      }

      /// Where the line from @p x along @p d leaves the body, in lengths of @p d; infinite if that
      /// is beyond two lengths.
      double exit(const Coordinates &x, const Coordinates &d) const
      {
        double nearest = std::numeric_limits<double>::infinity();
        const auto visit = [&](const std::size_t face, const double distance)
        {
          const Coordinates &out = surface.outward[face];
          if (const double along = dot(out, d); along > 0.)
            nearest = std::min(nearest,
                               meet(face, x, d,
                                    // A line that leaves the body where it begins.
                                    along > facing * norm(out) * norm(d) ? -rounding : rounding));
          return distance <= (1. + rounding) * norm(d);
        };
        search.visit_nearest(add_scaled(x, 1., d), visit);
        return nearest;
      }

      /// Where a line meets a face after @p begin, in lengths of @p d. The face is taken as
      /// triangles between its corners, or as a straight edge.
      double meet(const std::size_t face, const Coordinates &x, const Coordinates &d,
                  const double begin) const
      {
        double nearest = std::numeric_limits<double>::infinity();
        const std::vector<unsigned int> &nodes = geometry.nodes(face);
        const Coordinates a = geometry.point(nodes[0]);
        const auto meet_triangle = [&](const Coordinates &b, const Coordinates &c)
        {
          const Coordinates n = cross(b, c);
          const double across = dot(d, n), square = dot(n, n);
          if (!(std::fabs(across) > rounding * norm(d) * norm(n)))
            return;
          const double at = dot(a - x, n) / across;
          const Coordinates q = add_scaled(x - a, at, d);
          const double u = dot(cross(q, c), n) / square, v = dot(cross(b, q), n) / square;
          if (at > begin && std::min(u, v) >= -rounding && u + v <= 1. + rounding)
            nearest = std::min(nearest, at);
        };
        if (surface.dim == 2) // a triangle across the plane
          meet_triangle(geometry.point(nodes[1]) - a, {0., 0., 1.});
        else
          for (const FaceEdge &edge : face_edges(geometry.form(face), surface.degree))
            if (edge.first != 0 && edge.second != 0)
              meet_triangle(geometry.point(nodes[edge.first]) - a,
                            geometry.point(nodes[edge.second]) - a);
        return nearest;
      }

      const ContactSurface &surface;
      const SurfaceGeometry geometry;
      const FaceSearch search;
    };

    Boundaries(const SurfaceGeometry &s, const SurfaceGeometry &m, const WholeBoundaries &whole)
        : slave(whole.slave ? *whole.slave : s.surface()),
          master(whole.master ? *whole.master : m.surface()), points(m), search(m)
    {
    }

    /// Where the line through two places leaves the slave and the master, each from its own place:
    /// the smaller and the larger distance, over that of the places.
    std::pair<double, double> exits(const Coordinates &x, const Coordinates &p) const
    {
      return std::minmax({slave.exit(x, p - x), master.exit(p, x - p)});
    }

    const Boundary slave, master;
    const ClosestPoints points; ///< of the master's side of the contact, as the search
    const FaceSearch search;
  };

  Overlap::Overlap(const SurfaceGeometry &slave, const SurfaceGeometry &master,
                   const WholeBoundaries &boundaries)
      : slave(slave), master(master), whole(boundaries),
        limit(std::min(half_diagonal(slave), half_diagonal(master)))
  {
  }

  Overlap::~Overlap() = default;

  const Overlap::Boundaries &Overlap::boundaries() const
  {
    if (!made)
      made = std::make_unique<const Boundaries>(slave, master, whole);
    return *made;
  }

  bool Overlap::is_closed(const Coordinates &x, const Coordinates &p) const
  {
    const double depth = norm(p - x);
    return depth <= rounding * limit ||
           (depth <= limit && boundaries().exits(x, p).first >= 2. - rounding);
  }

  void Overlap::check(const Coordinates &x,
                      const std::function<bool(const Coordinates &normal)> &faces,
                      const bool no_contact) const
  {
    if (slave.surface().name == master.surface().name)
      return; // a body does not overlap itself
    const Boundaries &all = boundaries();
    ClosestPoint nearest;
    nearest.distance = std::numeric_limits<double>::infinity();
    const auto visit = [&](const std::size_t face, const double distance)
    {
      const ClosestPoint found = all.points.find(face, x);
      if (found.distance < nearest.distance &&
          (!no_contact || faces(master.at(face, found.reference).normal())))
        nearest = found;
      return distance <= nearest.distance;
    };
    all.search.visit_nearest(x, visit);
    if (std::isinf(nearest.distance))
      return;
    const FacePoint p = master.at(nearest.face, nearest.reference);
    if (nearest.on_open_border || !faces(p.normal()) ||
        dot(p.position - x, p.normal()) < along_normal * nearest.distance ||
        is_closed(x, p.position))
      return;
    const auto [thinner, thicker] = all.exits(x, p.position);
    if (thicker > 1.)
      throw UserError(to_text("contact surfaces '", slave.surface().name, "' and '",
                              master.surface().name, "': they overlap by ", nearest.distance,
                              " m at (", x,
                              "), by more than half of the thickness of the thinner "
                              "body there, ",
                              thinner * nearest.distance,
                              " m. Move the bodies apart, or name the sides that face each other"));
  }
} // namespace taut
