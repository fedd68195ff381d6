// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "solid/nodal_areas.h"
#include <taut/base/exceptions.h>
#include <taut/solid/contact_constraints.h>
#include <taut/solid/rigid_obstacle.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Smallest cosine of a face that faces an obstacle.
    constexpr double facing_obstacle = .01;

    [[noreturn]] void complain_about_reach(const ContactSurface &surface, const double reach,
                                           const double nearest)
    {
      throw UserError("contact surface '" + surface.name +
                      "': no node of it faces the obstacle within the search distance of " +
                      to_text(reach) + " m; the nearest is " + to_text(nearest) +
                      " m away. Check the position of the obstacle, or enlarge the search "
                      "distance");
    }

    /// Areas of the nodes of a line in space. A line has no side: it faces the obstacle completely,
    /// and a node has half of the lengths of its edges.
    std::vector<SurfaceConstraint> of_line(const ContactSurface &line,
                                           const RigidObstacle &obstacle, const double thickness,
                                           const double search_distance)
    {
      std::vector<double> length(line.points.size(), 0.);
      for (const std::vector<unsigned int> &edge : line.faces)
        for (const unsigned int node : edge)
          length[node] += .5 * norm(line.points[edge[1]] - line.points[edge[0]]);
      std::vector<SurfaceConstraint> constraints;
      double nearest = std::numeric_limits<double>::infinity();
      for (unsigned int node = 0; node < length.size(); ++node)
      {
        const RigidObstacle::Distance distance = obstacle.distance(line.points[node]);
        nearest = std::min(nearest, std::fabs(distance.value));
        if (std::fabs(distance.value) > search_distance)
          continue;
        SurfaceConstraint c;
        c.node = node;
        c.point = line.points[node];
        c.normal = scaled(-1., distance.normal);
        c.area = length[node] * thickness;
        c.slave = {{node, distance.normal}};
        c.gap = distance.value;
        constraints.push_back(std::move(c));
      }
      if (constraints.empty())
        complain_about_reach(line, search_distance, nearest);
      return constraints;
    }
  } // namespace

  std::vector<SurfaceConstraint> obstacle_constraints(const ContactSurface &surface,
                                                      const RigidObstacle &obstacle,
                                                      const double thickness,
                                                      const double search_distance)
  {
    if (surface.dim < 3)
      check_thickness(thickness);
    if (!(search_distance > 0.))
      throw UserError("contact surface '" + surface.name + "': the search distance is " +
                      to_text(search_distance) + " m, it must be positive");
    if (surface.dim == 1)
      return of_line(surface, obstacle, thickness, search_distance);
    const SurfaceGeometry geometry(surface);
    const NodalAreas areas(geometry);
    std::vector<RigidObstacle::Distance> distances(surface.points.size());
    for (unsigned int node = 0; node < distances.size(); ++node)
      if (!areas.faces(node).empty())
        distances[node] = obstacle.distance(geometry.point(node));

    std::vector<SurfaceConstraint> constraints;
    double nearest = std::numeric_limits<double>::infinity();
    for (unsigned int node = 0; node < distances.size(); ++node)
    {
      if (areas.faces(node).empty())
        continue;
      SurfaceConstraint c;
      c.node = node;
      c.point = geometry.point(node);
      c.normal = scaled(-1., distances[node].normal);
      if (!(areas.largest_cosine(node, c.normal) > facing_obstacle))
        continue;
      nearest = std::min(nearest, std::fabs(distances[node].value));
      if (std::fabs(distances[node].value) > search_distance)
        continue;
      c.area = areas.area(node, c.normal) * (surface.dim == 2 ? thickness : 1.);
      for (const auto &[i, factor] : areas.amplitude(node))
      {
        c.slave.push_back({i, scaled(factor, distances[i].normal)});
        c.gap += factor * distances[i].value;
      }
      constraints.push_back(std::move(c));
    }
    if (constraints.empty() && !std::isinf(nearest))
      complain_about_reach(surface, search_distance, nearest);
    if (constraints.empty())
      throw UserError("contact surface '" + surface.name +
                      "': no node of it faces the obstacle. Check the boundary id, and the "
                      "direction or the side of the obstacle");
    return constraints;
  }
} // namespace taut
