// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rigid_obstacle_h
#define taut_rigid_obstacle_h

#include <taut/base/coordinates.h>

#include <functional>

namespace taut
{
  /// A rigid obstacle at rest, for obstacle_constraints(). Derive from it to bring another shape.
  class RigidObstacle
  {
  public:
    virtual ~RigidObstacle() = default;

    struct Distance
    {
      double value = 0.;  ///< from the surface of the obstacle; negative inside [m]
      Coordinates normal; ///< unit vector out of the obstacle: the gradient of the distance
    };

    /// Signed distance of a point x [m].
    virtual Distance distance(const Coordinates &x) const = 0;
  };

  /// The half space or half plane behind a plane or line.
  class PlaneObstacle : public RigidObstacle
  {
  public:
    /// @p normal points out of the obstacle; a length of zero is a UserError.
    PlaneObstacle(const Coordinates &point, const Coordinates &normal);
    Distance distance(const Coordinates &x) const override;

  private:
    Coordinates point, normal;
  };

  /// The side of the obstacle that the body is on.
  enum class ObstacleSide
  {
    outside, ///< of a solid ball or cylinder
    inside   ///< of a hollow ball or cylinder: a socket, a bore
  };

  /// A ball or a spherical socket; in the plane a disc or a round hole.
  class SphereObstacle : public RigidObstacle
  {
  public:
    /// @p radius [m] must be positive (else: UserError).
    SphereObstacle(const Coordinates &centre, double radius, ObstacleSide side);
    Distance distance(const Coordinates &x) const override;

  private:
    Coordinates centre;
    double radius;
    ObstacleSide side;
  };

  /// An infinite circular cylinder or bore. With an axis along z it is a disc or hole of the plane.
  class CylinderObstacle : public RigidObstacle
  {
  public:
    /// A point of the axis, the direction of the axis, and the radius [m]. A direction of length
    /// zero, or a radius that is not positive, is a UserError.
    CylinderObstacle(const Coordinates &axis_point, const Coordinates &axis_direction,
                     double radius, ObstacleSide side);
    Distance distance(const Coordinates &x) const override;

  private:
    Coordinates point, axis;
    double radius;
    ObstacleSide side;
  };

  /**
   * The region below a graph: x is in the obstacle if up . x < height(foot of x). The foot of x is
   * the projection of x onto the plane through the origin across @p up. In the plane with up = (0,
   * 1, 0) the obstacle is y < f(x). For an obstacle above the body, up points down and heights are
   * measured downwards.
   *
   * The distance is that of the closest point of the graph, found by Gauss-Newton iterations from
   * the foot. If these do not converge (at kinks, or farther away than the radius of curvature),
   * the distance is that of the tangent plane at the foot.
   */
  class HeightObstacle : public RigidObstacle
  {
  public:
    /// Height above the origin along @p up [m], at the foot of a point.
    using Height = std::function<double(const Coordinates &foot)>;

    /// Derivatives of the height with respect to x, y, z of the foot [1].
    using Gradient = std::function<Coordinates(const Coordinates &foot)>;

    /// Derivatives are central differences with the step @p difference [m]. Take about 1e-5 of the
    /// length over which heights change; the error of derivatives is then 1e-10. Throws UserError
    /// if @p up or @p difference is zero; distance() throws it if a height is not a number.
    HeightObstacle(unsigned int dim, const Coordinates &up, Height height, double difference);

    /// An obstacle with given derivatives of the height.
    HeightObstacle(unsigned int dim, const Coordinates &up, Height height, Gradient gradient);

    Distance distance(const Coordinates &x) const override;

  private:
    struct Plane
    {
      Coordinates point, normal;
    };
    void set_directions(const Coordinates &direction);
    double height_at(const Coordinates &foot) const;
    Plane tangent_plane(const Coordinates &foot) const;

    unsigned int dim;
    Coordinates up, across[2]; ///< an orthonormal basis; in the plane without across[1]
    Height height;
    Gradient gradient; ///< may be empty
    double difference = 0.;
  };
} // namespace taut

#endif
