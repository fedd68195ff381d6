// SPDX-License-Identifier: LGPL-2.1-or-later
#include "overlap.h"
#include "closest_point.h"
#include "face_search.h"
#include <taut/base/exceptions.h>
#include <taut/base/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace taut
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /// Part of a line, or of a face, by which places on faces round.
    constexpr double rounding = 1e-6;

    double half_diagonal(const ContactSurface &surface)
    {
      const auto point = [&surface](const unsigned int node)
      {
        const Coordinates &x = surface.points[node];
        return Coordinates{x.x, x.y, surface.dim == 2 ? 0. : x.z};
      };
      Box box{point(surface.faces.front().front()), point(surface.faces.front().front())};
      for (const auto *const faces : {&surface.faces, &surface.other_faces})
        for (const std::vector<unsigned int> &face : *faces)
          for (const unsigned int node : face)
            box.add(point(node));
      return .5 * box.diagonal();
    }

    ContactSurface all_faces(ContactSurface surface)
    {
      const auto append = [](auto &to, const auto &from)
      { to.insert(to.end(), from.begin(), from.end()); };
      append(surface.faces, surface.other_faces);
      append(surface.outward, surface.other_outward);
      return surface;
    }

    /// All of the boundary of a body.
    struct Boundary
    {
      explicit Boundary(const ContactSurface &part)
          : surface(all_faces(part)), geometry(surface), search(geometry)
      {
      }

      /// Where the line from @p x along @p d leaves the body, in lengths of @p d; infinite if that
      /// is beyond two lengths.
      double exit(const Coordinates &x, const Coordinates &d) const
      {
        double nearest = infinity;
        search.visit_nearest(add_scaled(x, 1., d),
                             [&](const std::size_t face, const double distance)
                             {
                               if (distance > (1. + rounding) * norm(d))
                                 return false;
                               if (dot(surface.outward[face], d) > 0.)
                                 nearest = std::min(nearest, meet(face, x, d));
                               return true;
                             });
        return nearest;
      }

      /// Where a line meets a face, taken as triangles between its corners, or as a straight edge.
      double meet(const std::size_t face, const Coordinates &x, const Coordinates &d) const
      {
        std::vector<Coordinates> corners;
        for (const FaceEdge &edge : face_edges(geometry.form(face), surface.degree))
          corners.push_back(geometry.point(geometry.nodes(face)[edge.first]));
        if (corners.empty()) // an edge in the plane, as a triangle across it
          corners = {geometry.point(geometry.nodes(face)[0]),
                     geometry.point(geometry.nodes(face)[1]),
                     {geometry.point(geometry.nodes(face)[0]).x,
                      geometry.point(geometry.nodes(face)[0]).y, 1.}};
        double nearest = infinity;
        for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        {
          const Coordinates b = corners[k] - corners[0], c = corners[k + 1] - corners[0],
                            n = cross(b, c);
          const double across = dot(d, n);
          if (!(std::fabs(across) > rounding * norm(d) * norm(n)))
            continue;
          const double at = dot(corners[0] - x, n) / across;
          const Coordinates q = add_scaled(x - corners[0], at, d);
          const double u = dot(cross(q, c), n) / dot(n, n), v = dot(cross(b, q), n) / dot(n, n);
          if (at > rounding && std::min(u, v) >= -rounding && u + v <= 1. + rounding)
            nearest = std::min(nearest, at);
        }
        return nearest;
      }

      const ContactSurface surface;
      const SurfaceGeometry geometry;
      const FaceSearch search;
    };
  } // namespace

  struct Overlap::Boundaries
  {
    Boundaries(const SurfaceGeometry &s, const SurfaceGeometry &m)
        : slave(s.surface()), master(m.surface()), points(m), search(m)
    {
    }

    /// Where the line through two places leaves the slave, and the master, each from its own place:
    /// the smaller and the larger one, over the distance of the places.
    std::pair<double, double> exits(const Coordinates &x, const Coordinates &p) const
    {
      return std::minmax({slave.exit(x, p - x), master.exit(p, x - p)});
    }

    const Boundary slave, master;
    const ClosestPoints points; ///< of the master's side of the contact
    const FaceSearch search;
  };

  Overlap::Overlap(const SurfaceGeometry &slave, const SurfaceGeometry &master)
      : slave(slave), master(master),
        limit(std::min(half_diagonal(slave.surface()), half_diagonal(master.surface())))
  {
  }

  Overlap::~Overlap() = default;

  const Overlap::Boundaries &Overlap::boundaries() const
  {
    if (!made)
      made = std::make_unique<const Boundaries>(slave, master);
    return *made;
  }

  bool Overlap::is_closed(const Coordinates &x, const Coordinates &p) const
  {
    const double depth = norm(p - x);
    return depth <= rounding * limit ||
           (depth <= limit && boundaries().exits(x, p).first >= 2. - rounding);
  }

  void Overlap::check(const Coordinates &x,
                      const std::function<bool(const Coordinates &normal)> &faces) const
  {
    if (slave.surface().name == master.surface().name)
      return; // a body does not overlap itself
    std::optional<ClosestPoint> nearest;
    boundaries().search.visit_nearest(x,
                                      [&](const std::size_t face, const double distance)
                                      {
                                        if (nearest && distance > nearest->distance)
                                          return false;
                                        const ClosestPoint found =
                                            boundaries().points.find(face, x);
                                        if (!nearest || found.distance < nearest->distance)
                                          nearest = found;
                                        return true;
                                      });
    const FacePoint p = master.at(nearest->face, nearest->reference);
    const Coordinates d = p.position - x;
    if (nearest->on_open_border || dot(d, p.area) <= 0. || !faces(p.normal()) ||
        is_closed(x, p.position))
      return;
    const auto [first, last] = boundaries().exits(x, p.position);
    if (last > 1.)
      throw UserError(to_text("contact surfaces '", slave.surface().name, "' and '",
                              master.surface().name, "': they overlap by ", norm(d), " m at (", x,
                              "), by more than half of the thickness of the thinner body there, ",
                              first * norm(d),
                              " m. Move the bodies apart, or name the sides that "
                              "face each other"));
  }
} // namespace taut
