// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surface_geometry.h"
#include <taut/solid/contact_constraints.h>
#include <taut/solid/rigid_obstacle.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace taut
{
  namespace
  {
    /// Height over the length of a face below which an obstacle does not stand out: the strain that
    /// makes room for it.
    constexpr double flat = 1e-4;

    /// Smallest cosine of a face that faces an obstacle.
    constexpr double facing_obstacle = .01;

    /// Times that the distance of samples is halved to find the place that stands out most.
    constexpr unsigned int halvings = 10;

    /// How an obstacle stands out between the nodes of a face of a surface or line.
    class FaceOfObstacle
    {
    public:
      FaceOfObstacle(const ContactSurface &surface, const std::size_t face,
                     const RigidObstacle &obstacle)
          : surface(surface), nodes(surface.faces[face]), obstacle(obstacle),
            form(face_form(std::max(surface.dim, 2u), surface.degree, nodes.size()))
      {
        for (const unsigned int node : nodes)
          distances.push_back(obstacle.distance(surface.points[node]).value);
      }

      FaceShapes shapes(const ReferencePoint &r) const
      {
        return face_shapes(form, surface.degree, r);
      }

      Coordinates point(const ReferencePoint &r) const
      {
        const FaceShapes s = shapes(r);
        Coordinates x;
        for (unsigned int i = 0; i < s.n; ++i)
          x = add_scaled(x, s.value[i], surface.points[nodes[i]]);
        return x;
      }

      /// Height of the obstacle above the surface that nodes see [m].
      double height(const ReferencePoint &r) const
      {
        const FaceShapes s = shapes(r);
        double seen = 0.;
        for (unsigned int i = 0; i < s.n; ++i)
          seen += s.value[i] * distances[i];
        return seen - obstacle.distance(point(r)).value;
      }

      /// Where the height is largest.
      ReferencePoint highest() const
      {
        const bool is_line = form == FaceForm::line;
        const unsigned int parts = is_line ? 8 : 4;
        ReferencePoint best = centre(form);
        double largest = height(best);
        const auto consider = [&](const ReferencePoint &r)
        {
          if (r.x < 0. || r.y < 0. || r.x > 1. || r.y > 1. ||
              (form == FaceForm::triangle && r.x + r.y > 1.))
            return;
          if (const double here = height(r); here > largest)
          {
            largest = here;
            best = r;
          }
        };
        for (unsigned int i = 0; i <= parts; ++i)
          for (unsigned int j = 0; j <= (is_line ? 0 : parts); ++j)
            consider({i / static_cast<double>(parts), j / static_cast<double>(parts)});
        double step = .5 / parts;
        for (unsigned int k = 0; k < halvings && largest > 0.; ++k, step *= .5)
          for (const double by : {step, -step})
          {
            consider({best.x + by, best.y});
            if (!is_line)
              consider({best.x, best.y + by});
          }
        return best;
      }

      /// The larger curvature of the obstacle at a place along the two axes of the face [1/m].
      double curvature(const ReferencePoint &r) const
      {
        constexpr double step = 1. / 32.;
        const double here = height(r);
        double largest = 0.;
        for (const ReferencePoint &by : {ReferencePoint{step, 0.}, ReferencePoint{0., step}})
        {
          const ReferencePoint next{r.x + by.x, r.y + by.y}, last{r.x - by.x, r.y - by.y};
          const double length = .5 * norm(point(next) - point(last));
          if (length > 0.)
            largest =
                std::max(largest, (2. * here - height(next) - height(last)) / length / length);
        }
        return largest;
      }

      double length() const
      {
        Box box{surface.points[nodes[0]], surface.points[nodes[0]]};
        for (const unsigned int node : nodes)
          box.add(surface.points[node]);
        return box.diagonal() / (form == FaceForm::line ? 1. : std::sqrt(2.));
      }

    private:
      const ContactSurface &surface;
      const std::vector<unsigned int> &nodes;
      const RigidObstacle &obstacle;
      const FaceForm form;
      std::vector<double> distances; ///< of the nodes [m]
    };
  } // namespace

  double InnerPoint::needed_face(const double depth) const
  {
    // The chord of an arc has the length 2 sqrt(2 depth / curvature).
    const double quarter = curvature > 0. ? std::sqrt(.5 * depth / curvature) : element;
    return std::min({.5 * face, element, quarter});
  }

  std::vector<InnerPoint> obstacle_inner_points(const ContactSurface &surface,
                                                const RigidObstacle &obstacle,
                                                const double search_distance)
  {
    std::optional<SurfaceGeometry> geometry;
    if (surface.dim > 1)
      geometry.emplace(surface);
    std::vector<InnerPoint> result;
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
    {
      const FaceOfObstacle face(surface, f, obstacle);
      const ReferencePoint place = face.highest();
      if (!(face.height(place) > flat * face.length()))
        continue;
      const RigidObstacle::Distance distance = obstacle.distance(face.point(place));
      if (std::fabs(distance.value) > search_distance ||
          (geometry && !(-dot(geometry->at(f, place).normal(), distance.normal) > facing_obstacle)))
        continue;
      InnerPoint p;
      p.face = face.length();
      p.curvature = face.curvature(place);
      p.constraint.node = surface.faces[f][0];
      p.constraint.point = face.point(place);
      p.constraint.normal = scaled(-1., distance.normal);
      p.constraint.gap = distance.value;
      const FaceShapes shapes = face.shapes(place);
      for (unsigned int i = 0; i < shapes.n; ++i)
        p.constraint.slave.push_back(
            {surface.faces[f][i], scaled(shapes.value[i], distance.normal)});
      result.push_back(std::move(p));
    }
    return result;
  }
} // namespace taut
