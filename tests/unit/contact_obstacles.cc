// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: nodal constraints against rigid obstacles have exact distances, positive areas that add up
// to those of the faces, and consistent loads of a pressure. Source: closed forms, quadrature.
#include "common.h"
#include "contact_meshes_space.h"

#include <taut/solid/contact_constraints.h>
#include <taut/solid/rigid_obstacle.h>

namespace
{
  using namespace contact_meshes;

  /// Shape functions of a face, from the powers that they are sums of.
  std::vector<double> shapes(const Form &form, const double x, const double y)
  {
    using Values = std::vector<double>;
    const double z = 1. - x - y;
    if (form.triangles && form.degree == 1)
      return {z, x, y};
    if (form.triangles)
      return {z * (2. * z - 1.), x * (2. * x - 1.), y * (2. * y - 1.),
              4. * z * x,        4. * x * y,        4. * y * z};
    const auto lines = [&form](const double t)
    {
      return form.degree == 1
                 ? Values{1. - t, t}
                 : Values{(1. - t) * (1. - 2. * t), 4. * t * (1. - t), t * (2. * t - 1.)};
    };
    Values value;
    for (const double b : lines(y))
      for (const double a : lines(x))
        value.push_back(a * b);
    return value;
  }

  /// Consistent loads of a pressure of 1 along @p direction on plane faces, by Gauss points of
  /// degree 5 in each direction; edges are straight and middles in the middle.
  Vectors plane_loads(const ContactSurface &surface, const Form &form, const Coordinates &direction)
  {
    Vectors load(surface.points.size());
    const double root = std::sqrt(.15), at[3] = {.5 - root, .5, .5 + root},
                 weight[3] = {5. / 18., 8. / 18., 5. / 18.};
    for (const std::vector<unsigned int> &face : surface.faces)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          const double x = at[i], y = form.triangles ? (1. - at[i]) * at[j] : at[j],
                       w = weight[i] * weight[j] * (form.triangles ? 1. - at[i] : 1.);
          const std::vector<double> phi = shapes(form, x, y);
          // Vertices of the face at (0, 0), (1, 0), (0, 1), (1, 1).
          const unsigned int corner = form.degree, last = (corner + 1) * (corner + 1) - 1;
          const Coordinates a = surface.points[face[0]],
                            b = surface.points[face[form.triangles ? 1 : corner]],
                            c = surface.points[face[form.triangles ? 2 : last - corner]],
                            mixed = form.triangles ? Coordinates()
                                                   : (surface.points[face[last]] - b) - (c - a);
          const double area = norm(cross(add_scaled(b - a, y, mixed), add_scaled(c - a, x, mixed)));
          for (std::size_t k = 0; k < face.size(); ++k)
            load[face[k]] = add_scaled(load[face[k]], w * area * phi[k], direction);
        }
    return load;
  }

  TEST(Obstacle, PatchTestOnAPlaneInSpace)
  {
    std::mt19937 random(1);
    const Coordinates e1 = {.6, 0., .8}, e2 = {0., 1., 0.}, out = {-.8, 0., .6};
    for (const Form &form : forms)
    {
      const ContactSurface surface = square(form, 4, random, {1., 2., 3.}, e1, e2, -1.);
      // The plane is 0.1 away where the body looks.
      const Coordinates outward = cross(e2, e1);
      const taut::PlaneObstacle plane(add_scaled({1., 2., 3.}, .1, outward), times(-1., outward));
      const Constraints constraints = obstacle_constraints(surface, plane);
      ASSERT_EQ(constraints.size(), surface.points.size());
      EXPECT_NEAR(total_area(constraints), 1., exact);
      for (const SurfaceConstraint &c : constraints)
      {
        EXPECT_GT(c.area, 1e-3);
        EXPECT_NEAR(c.gap, .1, exact);
        EXPECT_LT(norm(c.normal - outward), exact);
        EXPECT_NEAR(
            gap(c, surface, surface, [&](const Coordinates &) { return times(.3, outward); }, {}),
            -.2, exact);
      }
      const Vectors loads = plane_loads(surface, form, out);
      EXPECT_LT(error_of_forces(constraints, &SurfaceConstraint::slave, loads), exact)
          << form.degree << form.triangles;
    }
  }

  /// Half squares, half triangles of degree 2: middles of shared edges have one basis.
  TEST(Obstacle, PatchTestOnMixedFaces)
  {
    std::mt19937 random(2);
    ContactSurface surface = square({2, false}, 3, random);
    const Vectors first = plane_loads(surface, {2, false}, {0., 0., 1.});
    const ContactSurface more = square({2, true}, 3, random, {1., 0., 0.});
    const Vectors second = plane_loads(more, {2, true}, {0., 0., 1.});
    Vectors expected = first;
    std::vector<unsigned int> number;
    for (std::size_t i = 0; i < more.points.size(); ++i)
    {
      unsigned int k = 0;
      while (k < surface.points.size() && norm(surface.points[k] - more.points[i]) > 1e-9)
        ++k;
      surface.points.resize(std::max<std::size_t>(surface.points.size(), k + 1), more.points[i]);
      expected.resize(surface.points.size());
      expected[k] = add_scaled(expected[k], 1., second[i]);
      number.push_back(k);
    }
    EXPECT_LT(surface.points.size(), first.size() + second.size());
    for (std::vector<unsigned int> face : more.faces)
    {
      for (unsigned int &node : face)
        node = number[node];
      surface.faces.push_back(face);
      surface.outward.push_back({0., 0., -1.});
    }
    const Constraints constraints =
        obstacle_constraints(surface, taut::PlaneObstacle({}, {0., 0., 2.}));
    EXPECT_NEAR(total_area(constraints), 2., exact);
    EXPECT_LT(error_of_forces(constraints, &SurfaceConstraint::slave, expected), exact);
    for (const SurfaceConstraint &c : constraints)
      EXPECT_GT(c.area, 0.);
  }

  /// A sphere in a socket: distances, and areas, which add up to those of the faces.
  TEST(Obstacle, SphereInASocket)
  {
    std::mt19937 random(3);
    for (const Form &form : forms)
    {
      const ContactSurface surface = sphere(form, 4, 2., random);
      const Constraints constraints =
          obstacle_constraints(surface, taut::SphereObstacle({}, 2.5, taut::ObstacleSide::inside));
      EXPECT_EQ(constraints.size(), surface.points.size());
      for (const SurfaceConstraint &c : constraints)
      {
        EXPECT_NEAR(c.gap, .5, exact);
        EXPECT_GT(c.area, 0.);
        EXPECT_LT(norm(c.normal - times(.5, c.point)), exact);
      }
      const double pi = std::acos(-1.);
      // Degree 1: plane triangles exactly.
      double faces = 0.;
      if (form.triangles && form.degree == 1)
      {
        for (const auto &f : surface.faces)
          faces += .5 * norm(cross(surface.points[f[1]] - surface.points[f[0]],
                                   surface.points[f[2]] - surface.points[f[0]]));
        EXPECT_NEAR(total_area(constraints), faces, 1e-12);
      }
      EXPECT_NEAR(total_area(constraints) / (16. * pi), 1., form.degree == 1 ? .05 : 1e-3);
      // A ball on a floor: its lower half faces it, and moved down to it all gaps are closed.
      const Constraints floor =
          obstacle_constraints(surface, taut::PlaneObstacle({0., 0., -2.}, {0., 0., 1.}));
      for (const SurfaceConstraint &c : floor)
      {
        EXPECT_LT(c.point.z, .5);
        double closed = c.gap;
        for (const taut::NodeWeight &w : c.slave)
          closed -= w.weight.z * (surface.points[w.node].z + 2.);
        EXPECT_NEAR(closed, 0., exact);
      }
      EXPECT_GT(floor.size(), surface.points.size() / 3);
    }
  }

  TEST(Obstacle, DistancesOfRoundOnes)
  {
    const Coordinates point = {1., 2., 3.};
    const taut::CylinderObstacle bore(point, {0., 0., 5.}, 2., taut::ObstacleSide::inside),
        shaft(point, {0., 3., 4.}, .5, taut::ObstacleSide::outside);
    auto d = bore.distance({1., 3.5, -7.});
    EXPECT_NEAR(d.value, .5, exact);
    EXPECT_LT(norm(d.normal - Coordinates{0., -1., 0.}), exact);
    d = shaft.distance(add_scaled(add_scaled(point, 7., {0., .6, .8}), 2., {0., -.8, .6}));
    EXPECT_NEAR(d.value, 1.5, exact);
    EXPECT_LT(norm(d.normal - Coordinates{0., -.8, .6}), exact);
    EXPECT_NEAR(shaft.distance(point).value, -.5, exact);
    EXPECT_NEAR(norm(shaft.distance(point).normal), 1., exact);
    const taut::SphereObstacle ball(point, .5, taut::ObstacleSide::outside);
    d = ball.distance({1., 2., 3.25});
    EXPECT_NEAR(d.value, -.25, exact);
    EXPECT_NEAR(d.normal.z, 1., exact);
    EXPECT_NEAR(ball.distance(point).value, -.5, exact);
  }

  /// Heights whose distances are known: inclined plane, circle, sphere; differences, derivatives.
  TEST(Obstacle, DistancesOfHeights)
  {
    const taut::HeightObstacle incline(
        3, {0., 2., 0.}, [](const Coordinates &x) { return 1. + .3 * x.x - .4 * x.z; }, 1e-5);
    const Coordinates n = times(1. / std::sqrt(1.25), {-.3, 1., .4});
    EXPECT_NEAR(incline.distance(add_scaled({0., 1., 0.}, .7, n)).value, .7, 1e-10);
    EXPECT_LT(norm(incline.distance({5., 6., 7.}).normal - n), 1e-9);
    const auto arc = [](const Coordinates &x) { return std::sqrt(4. - x.x * x.x) - 2.; };
    const auto slope = [](const Coordinates &x) {
      return Coordinates{-x.x / std::sqrt(4. - x.x * x.x), 0., 0.};
    };
    const taut::HeightObstacle circle(2, {0., 1., 0.}, arc, 1e-5),
        given(2, {0., 1., 0.}, arc, slope);
    const taut::SphereObstacle disc({0., -2., 0.}, 2., taut::ObstacleSide::outside);
    for (const Coordinates x :
         {Coordinates{.3, .2, 0.}, {-1., .1, 0.}, {.5, -.4, 0.}, {.2, -.02, 0.}})
    {
      EXPECT_NEAR(circle.distance(x).value, disc.distance(x).value, 1e-9);
      EXPECT_NEAR(given.distance(x).value, disc.distance(x).value, 1e-12);
      EXPECT_LT(norm(given.distance(x).normal - disc.distance(x).normal), 1e-11);
    }
    // A ceiling at y = 1 + z^2: downwards its height is -y.
    const taut::HeightObstacle ceiling(
        3, {0., -1., 0.}, [](const Coordinates &x) { return -1. - x.z * x.z; }, 1e-5);
    EXPECT_NEAR(ceiling.distance({3., .25, 0.}).value, .75, 1e-9);
    EXPECT_NEAR(ceiling.distance({3., 1.25, 0.}).value, -.25, 1e-9);
    // A kink: some distance between that to the flanks and that along the height.
    const taut::HeightObstacle roof(
        2, {0., 1., 0.}, [](const Coordinates &x) { return -std::fabs(x.x); }, 1e-5);
    EXPECT_NEAR(roof.distance({0., .5, 0.}).value, .5, 1e-9);
  }

  /// In the plane: areas of a uniform pressure, sides of a block, thickness.
  TEST(Obstacle, SidesOfABlock)
  {
    std::mt19937 random(4);
    for (const unsigned int degree : {1u, 2u})
    {
      // Down the left side, along the bottom, up the right side.
      const auto path = [](const double s)
      {
        return s < 0.   ? Coordinates{0., -s, 0.}
               : s > 1. ? Coordinates{1., s - 1., 0.}
                        : Coordinates{s, 0., 0.};
      };
      const ContactSurface block =
          on_curve({-.6, -.2, 0., .3, .4, 1., 1.5}, degree, path, false, random);
      const Constraints constraints =
          obstacle_constraints(block, taut::PlaneObstacle({0., -.1, 0.}, {0., 1., 0.}), .5);
      EXPECT_EQ(constraints.size(), 3 * degree + 1);
      EXPECT_NEAR(total_area(constraints), .5, exact);
      const ContactSurface bottom = on_curve({0., .3, .4, 1.}, degree, level(0.), false, random);
      const Vectors expected = consistent_loads(bottom, {}, {1., 0., 0.}, 0., 1., {0., .5, 0.});
      for (const SurfaceConstraint &c : constraints)
        for (std::size_t i = 0; i < expected.size(); ++i)
          EXPECT_TRUE(norm(bottom.points[i] - c.point) >= 1e-12 ||
                      std::fabs(c.area - expected[i].y) < exact);
    }
  }

  TEST(Obstacle, Errors)
  {
    std::mt19937 random(5);
    const ContactSurface surface = square({1, false}, 2, random);
    const auto message = [&surface](const taut::RigidObstacle &obstacle, const double distance) {
      return verification::error_of([&] { obstacle_constraints(surface, obstacle, 1., distance); });
    };
    const auto has = [](const std::string &text, const std::string &part)
    { EXPECT_TRUE(verification::has(text, part)) << text; };
    const taut::PlaneObstacle below({0., 0., -1.}, {0., 0., 1.}),
        above({0., 0., 1.}, {0., 0., -1.});
    EXPECT_EQ(message(below, 2.), "");
    has(message(below, .5), "the nearest is 1 m away");
    has(message(above, 2.), "no node of it faces the obstacle");
    has(message(below, -1.), "search distance is -1 m");
    EXPECT_THROW(taut::PlaneObstacle({}, {}), taut::UserError);
    EXPECT_THROW(taut::SphereObstacle({}, 0., taut::ObstacleSide::inside), taut::UserError);
    EXPECT_THROW(taut::CylinderObstacle({}, {}, 1., taut::ObstacleSide::inside), taut::UserError);
    EXPECT_THROW(taut::HeightObstacle(2, {0., 0., 1.}, {}, 1e-5), taut::UserError);
    EXPECT_THROW(taut::HeightObstacle(2, {0., 1., 0.}, {}, 0.), taut::UserError);
    const taut::HeightObstacle nowhere(
        3, {0., 0., 1.}, [](const Coordinates &) { return std::nan(""); }, 1e-5);
    has(message(nowhere, 2.), "is no number");
  }
} // namespace
