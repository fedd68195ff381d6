// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/surface_geometry.h"
#include <taut/solid/contact_constraints.h>
#include <taut/solid/rigid_obstacle.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Height over the length of a face below which an obstacle does not stand out: the strain that
    /// makes room for it.
    constexpr double least_height = 1e-4;

    /// Parts of a face along each direction, on a line and in space, between which heights are
    /// taken: a bump of one part is seen.
    constexpr unsigned int parts_of_line = 32, parts_of_face = 8;

    /// Elements in the width of a bump that see it: its middle and both flanks.
    constexpr double elements_in_width = 4.;
  } // namespace

  std::vector<InnerPoint> obstacle_inner_points(const ContactSurface &surface,
                                                const RigidObstacle &obstacle,
                                                const double search_distance)
  {
    std::vector<InnerPoint> result;
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
    {
      const std::vector<unsigned int> &nodes = surface.faces[f];
      const FaceForm form = face_form(std::max(surface.dim, 2u), surface.degree, nodes.size());
      const bool is_line = form == FaceForm::line;
      std::vector<double> at_nodes;
      Box box{surface.points[nodes[0]], surface.points[nodes[0]]};
      for (const unsigned int node : nodes)
      {
        at_nodes.push_back(obstacle.distance(surface.points[node]).value);
        box.add(surface.points[node]);
      }
      InnerPoint p;
      p.face = box.diagonal() / (is_line ? 1. : std::sqrt(2.));
      // Heights of the obstacle above what nodes see.
      std::vector<double> heights;
      double largest = least_height * p.face;
      const unsigned int n = is_line ? parts_of_line : parts_of_face;
      for (unsigned int i = 0; i <= n; ++i)
        for (unsigned int j = 0; j <= (is_line ? 0 : form == FaceForm::triangle ? n - i : n); ++j)
        {
          const FaceShapes shapes = face_shapes(
              form, surface.degree, {i / static_cast<double>(n), j / static_cast<double>(n)});
          Coordinates x;
          double seen = 0.;
          for (unsigned int k = 0; k < shapes.n; ++k)
          {
            x = add_scaled(x, shapes.value[k], surface.points[nodes[k]]);
            seen += shapes.value[k] * at_nodes[k];
          }
          const RigidObstacle::Distance distance = obstacle.distance(x);
          heights.push_back(seen - distance.value);
          if (heights.back() <= largest || std::fabs(distance.value) > search_distance ||
              (surface.dim > 1 && dot(surface.outward[f], distance.normal) >= 0.))
            continue;
          largest = heights.back();
          SurfaceConstraint &c = p.constraint;
          c.node = nodes[0];
          c.point = x;
          c.normal = scaled(-1., distance.normal);
          c.gap = distance.value;
          c.slave.clear();
          for (unsigned int k = 0; k < shapes.n; ++k)
            c.slave.push_back({nodes[k], scaled(shapes.value[k], distance.normal)});
        }
      if (p.constraint.slave.empty())
        continue;
      // The width is that of half of the height.
      const double part = std::count_if(heights.begin(), heights.end(),
                                        [largest](const double h) { return h >= .5 * largest; }) /
                          static_cast<double>(heights.size());
      p.needed_face = p.face * (is_line ? part : std::sqrt(part)) / elements_in_width;
      result.push_back(std::move(p));
    }
    return result;
  }
} // namespace taut
