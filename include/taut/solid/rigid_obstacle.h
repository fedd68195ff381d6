// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rigid_obstacle_h
#define taut_rigid_obstacle_h

#include <taut/base/coordinates.h>

#include <functional>

namespace taut
{
  /// A rigid obstacle that does not move.
  class RigidObstacle
  {
  public:
    virtual ~RigidObstacle() = default;

    struct Distance
    {
      double value = 0.;  ///< from the obstacle's surface; negative inside it [m]
      Coordinates normal; ///< unit vector out of the obstacle: the gradient of the distance
    };

    /// Signed distance of a point x [m].
    virtual Distance distance(const Coordinates &x) const = 0;
  };

  /// The half space or half plane behind a plane or line.
  class PlaneObstacle : public RigidObstacle
  {
  public:
    /// @p normal points out of the obstacle and has any length but zero (else: UserError).
    PlaneObstacle(const Coordinates &point, const Coordinates &normal);
    Distance distance(const Coordinates &x) const override;

  private:
    Coordinates point, normal;
  };

  /// Where the body is.
  enum class ObstacleSide
  {
    outside, ///< of a solid ball or cylinder
    inside   ///< of a hollow one: a socket, a bore
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
    /// A point of the axis, its direction of any length but zero, and a positive radius [m] (else:
    /// UserError).
    CylinderObstacle(const Coordinates &axis_point, const Coordinates &axis_direction,
                     double radius, ObstacleSide side);
    Distance distance(const Coordinates &x) const override;

  private:
    Coordinates point, axis;
    double radius;
    ObstacleSide side;
  };

  /**
   * All below a graph: x is in the obstacle if up . x < height(foot of x), with the foot of x its
   * projection onto the plane through the origin across @p up. In the plane with up = (0, 1, 0)
   * that is y < f(x). For an obstacle above the body, up points down and heights are measured
   * downwards.
   *
   * The distance is that of the closest point of the graph, found by Gauss-Newton iterations that
   * begin at the foot; where these do not converge (at kinks, or further away than the radius of
   * curvature) it is that of the tangent plane at the foot.
   */
  class HeightObstacle : public RigidObstacle
  {
  public:
    /// Height above the origin along @p up [m]; called with feet.
    using Height = std::function<double(const Coordinates &foot)>;

    /// Derivatives of the height with respect to x, y, z of the foot [1].
    using Gradient = std::function<Coordinates(const Coordinates &foot)>;

    /// @p up has any length but zero. Derivatives by central differences with the step
    /// @p difference [m], about 1e-5 of the length over which heights change; their error is
    /// 1e-10. UserError if one of the two is zero; distance() throws one if a height is no number.
    HeightObstacle(unsigned int dim, const Coordinates &up, Height height, double difference);

    /// The same with given derivatives.
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
