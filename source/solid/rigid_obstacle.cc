// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "solid/surface_geometry.h"
#include <taut/base/exceptions.h>
#include <taut/solid/rigid_obstacle.h>

#include <cmath>
#include <utility>

namespace taut
{
  namespace
  {
    /// Largest number of Gauss-Newton iterations for the closest point of a graph, and their last
    /// step over the distance from the foot, plus the rounding of coordinates.
    constexpr unsigned int most_iterations = 50;
    constexpr double converged = 1e-12, rounding_of_place = 1e-15;

    Coordinates direction(const Coordinates &a, const std::string &what)
    {
      const double length = norm(a);
      if (!(length > 0.) || !std::isfinite(length))
        throw UserError("obstacle: " + what + " must be a direction, not (" + to_text(a) + ")");
      return scaled(1. / length, a);
    }

    void check_radius(const double radius)
    {
      if (!(radius > 0.) || !std::isfinite(radius))
        throw UserError("obstacle: its radius is " + to_text(radius) + " m, it must be positive");
    }

    /// A unit vector across @p a.
    Coordinates perpendicular(const Coordinates &a)
    {
      const bool along_x = std::fabs(a.x) > .5 * norm(a);
      return normalised(cross(a, along_x ? Coordinates{0., 1., 0.} : Coordinates{1., 0., 0.}));
    }

    /// Distance from a round obstacle, with the vector from its axis or centre.
    RigidObstacle::Distance round(const Coordinates &from_centre, const double radius,
                                  const ObstacleSide side, const Coordinates &at_centre)
    {
      const double length = norm(from_centre), sign = side == ObstacleSide::outside ? 1. : -1.;
      const Coordinates radial = length > 0. ? scaled(1. / length, from_centre) : at_centre;
      return {sign * (length - radius), scaled(sign, radial)};
    }
  } // namespace

  PlaneObstacle::PlaneObstacle(const Coordinates &point, const Coordinates &normal)
      : point(point), normal(direction(normal, "the normal of a plane"))
  {
  }

  RigidObstacle::Distance PlaneObstacle::distance(const Coordinates &x) const
  {
    return {dot(x - point, normal), normal};
  }

  SphereObstacle::SphereObstacle(const Coordinates &centre, const double radius,
                                 const ObstacleSide side)
      : centre(centre), radius(radius), side(side)
  {
    check_radius(radius);
  }

  RigidObstacle::Distance SphereObstacle::distance(const Coordinates &x) const
  {
    return round(x - centre, radius, side, {0., 1., 0.});
  }

  CylinderObstacle::CylinderObstacle(const Coordinates &axis_point,
                                     const Coordinates &axis_direction, const double radius,
                                     const ObstacleSide side)
      : point(axis_point), axis(direction(axis_direction, "the axis of a cylinder")),
        radius(radius), side(side)
  {
    check_radius(radius);
  }

  RigidObstacle::Distance CylinderObstacle::distance(const Coordinates &x) const
  {
    const Coordinates d = x - point;
    return round(add_scaled(d, -dot(d, axis), axis), radius, side, perpendicular(axis));
  }

  HeightObstacle::HeightObstacle(const unsigned int dim, const Coordinates &up, Height height,
                                 const double difference)
      : dim(dim), height(std::move(height)), difference(difference)
  {
    if (!(difference > 0.) || !std::isfinite(difference))
      throw UserError("obstacle: the step of differences of its height is " + to_text(difference) +
                      " m, it must be positive");
    set_directions(up);
  }

  HeightObstacle::HeightObstacle(const unsigned int dim, const Coordinates &up, Height height,
                                 Gradient gradient)
      : dim(dim), height(std::move(height)), gradient(std::move(gradient))
  {
    set_directions(up);
  }

  void HeightObstacle::set_directions(const Coordinates &wanted)
  {
    up = direction(dim == 2 ? Coordinates{wanted.x, wanted.y, 0.} : wanted, "'up' of a height");
    across[0] = dim == 2 ? Coordinates{up.y, -up.x, 0.} : perpendicular(up);
    across[1] = cross(up, across[0]);
  }

  double HeightObstacle::height_at(const Coordinates &foot) const
  {
    const double value = height(foot);
    if (!std::isfinite(value))
      throw UserError("obstacle: its height at (" + to_text(foot) + ") is no number");
    return value;
  }

  HeightObstacle::Plane HeightObstacle::tangent_plane(const Coordinates &foot) const
  {
    Plane plane{add_scaled(foot, height_at(foot), up), up};
    for (unsigned int i = 0; i + 1 < dim; ++i)
    {
      const double slope = gradient ? dot(gradient(foot), across[i])
                                    : (height_at(add_scaled(foot, difference, across[i])) -
                                       height_at(add_scaled(foot, -difference, across[i]))) /
                                          (2. * difference);
      plane.normal = add_scaled(plane.normal, -slope, across[i]);
    }
    plane.normal = normalised(plane.normal);
    return plane;
  }

  RigidObstacle::Distance HeightObstacle::distance(const Coordinates &x) const
  {
    Coordinates foot = add_scaled(x, -dot(x, up), up);
    const Plane first = tangent_plane(foot);
    const double scale = std::fabs(dot(x - first.point, up));
    Plane plane = first;
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      // The projection of x onto the tangent plane, back down to the foot.
      const Coordinates d = x - plane.point;
      Coordinates step = add_scaled(d, -dot(d, plane.normal), plane.normal);
      step = add_scaled(step, -dot(step, up), up);
      if (norm(step) <= converged * scale + rounding_of_place * norm(x))
        return {dot(d, plane.normal), plane.normal};
      foot = add_scaled(foot, 1., step);
      plane = tangent_plane(foot);
    }
    return {dot(x - first.point, first.normal), first.normal};
  }
} // namespace taut
