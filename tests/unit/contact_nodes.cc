// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: nodes find their closest points on edges and faces, with exact distances and exact rigid
// motions, and these constraints fail the patch test. Expected: closed forms.
#include "common.h"
#include "contact_meshes_space.h"
#include <taut/solid/contact_constraints.h>

namespace
{
  using namespace contact_meshes;
  using taut::mortar_constraints;

  /// What node-to-segment constraints do with a uniform pressure: loads of the master off by more
  /// than a tenth of those of an edge, and linear gaps still exact.
  TEST(NodeToSegment, FailsThePatchTest)
  {
    std::mt19937 random(12);
    double worst = 0., rounding = 0.;
    for (unsigned int repeat = 0; repeat < 20; ++repeat)
    {
      const auto surface = [&](const unsigned int n, const bool left)
      { return on_curve(random_grid(n, 0., 1., random), 1, level(0.), left, random); };
      const ContactSurface slave = surface(4, true), master = surface(7, false);
      const Vectors loads = consistent_loads(master, {}, {1., 0., 0.}, 0., 1., {0., 1., 0.});
      const auto error = [&](const Constraints &constraints)
      { return 7. * error_of_forces(constraints, &SurfaceConstraint::master, loads); };
      const Constraints nodes = node_to_segment_constraints(slave, master);
      EXPECT_EQ(nodes.size(), 5u);
      EXPECT_NEAR(total_area(nodes), 1., exact);
      worst = std::max(worst, error(nodes));
      rounding = std::max(rounding, error(mortar_constraints(slave, master)));
    }
    EXPECT_GT(worst, .1);
    EXPECT_LT(rounding, exact);
    std::cout << "node-to-segment: " << worst << ", mortar: " << rounding << "\n";
  }

  TEST(NodeToSegment, DistancesAndRigidMotions)
  {
    std::mt19937 random(13);
    for (const unsigned int degree : {1u, 2u})
    {
      const auto f = [degree](const double x) { return .1 + .2 * x + (degree == 2 ? x * x : 0.); };
      const ContactSurface slave =
          on_curve(random_grid(9, 0., 1., random), degree, level(0.), true, random);
      const ContactSurface master =
          on_curve(random_grid(4, .2, 1.3, random), degree, graph(f), false, random);
      const auto turn = [](const Coordinates &x) { return Coordinates{-x.y, x.x, 0.}; };
      const Constraints constraints = node_to_segment_constraints(slave, master);
      EXPECT_GE(constraints.size(), 7u * degree);
      for (const SurfaceConstraint &c : constraints)
      {
        EXPECT_NEAR(gap(c, slave, master, turn, turn), c.gap, exact);
        if (degree == 1)
          EXPECT_NEAR(c.gap, f(slave.points[c.node].x) / std::hypot(1., .2), exact);
        else
        {
          // The foot is on the parabola, and the distance along its normal.
          Coordinates foot = add_scaled(slave.points[c.node], c.gap, c.normal);
          EXPECT_NEAR(foot.y, f(foot.x), exact);
          EXPECT_NEAR(c.normal.x * 1. + c.normal.y * (.2 + 2. * foot.x), 0., exact);
        }
      }
    }
  }
  /// Nodes on inclined faces: distances, rigid motions, no node beside the master.
  TEST(NodeToFace, DistancesAndRigidMotions)
  {
    std::mt19937 random(6);
    const Coordinates e1 = {.8, 0., .6}, e2 = {0., 1., 0.}, up = {-.6, 0., .8};
    for (const Form &form : forms)
      for (const Form &other : forms)
      {
        const ContactSurface slave = square(form, 4, random, {}, e1, e2, 1.);
        const ContactSurface master =
            square(other, 3, random, add_scaled(add_scaled(times(.2, up), .3, e1), -.1, e2), e1,
                   times(2., e2), -1.);
        std::size_t inside = 0;
        for (const Coordinates &x : slave.points)
          inside += dot(x, e1) >= .3;
        const Constraints constraints = node_to_face_constraints(slave, master);
        EXPECT_EQ(constraints.size(), inside);
        const auto turn = [](const Coordinates &x) { return cross({.3, -.2, .5}, x); };
        const auto rest = [](const Coordinates &) { return Coordinates(); };
        const auto field = [&](const Coordinates &x)
        { return times(.1 + .2 * dot(x, e1) - .3 * dot(x, e2), up); };
        for (const SurfaceConstraint &c : constraints)
        {
          EXPECT_NEAR(c.gap, .2, exact);
          EXPECT_GT(c.area, 0.);
          EXPECT_LT(norm(c.normal - up), exact);
          EXPECT_NEAR(gap(c, slave, master, turn, turn), .2, exact);
          EXPECT_NEAR(gap(c, slave, master, rest, field), .2 + dot(field(c.point), up), exact);
        }
      }
  }

  /// Spheres in spheres: distances up to the faces' own distance from the sphere.
  TEST(NodeToFace, Spheres)
  {
    std::mt19937 random(7);
    for (const Form &form : forms)
      for (const bool is_socket : {true, false})
      {
        ContactSurface ball = sphere(form, 5, 1., random),
                       socket = sphere({form.degree, !form.triangles}, 6, 1.2, random);
        for (Coordinates &outward : socket.outward)
          outward = times(-1., outward);
        const ContactSurface &slave = is_socket ? socket : ball,
                             &master = is_socket ? ball : socket;
        const Constraints constraints = node_to_face_constraints(slave, master);
        EXPECT_EQ(constraints.size(), slave.points.size());
        for (const SurfaceConstraint &c : constraints)
        {
          EXPECT_NEAR(c.gap, .2, form.degree == 1 ? .05 : 2e-3);
          EXPECT_GT(dot(c.normal, c.point) * (is_socket ? -1. : 1.), .9);
          const auto turn = [](const Coordinates &x) { return cross({.3, -.2, .5}, x); };
          EXPECT_NEAR(gap(c, slave, master, turn, turn), c.gap, 1e-10);
        }
      }
  }

  TEST(NodeToFace, TenThousandFacesInSeconds)
  {
    std::mt19937 random(9);
    const ContactSurface slave =
                             square({1, false}, 100, random, {}, {1., 0., 0.}, {0., 1., 0.}, 1.),
                         master = square({1, false}, 100, random);
    Constraints constraints;
    const double seconds =
        seconds_of([&] { constraints = node_to_face_constraints(slave, master); });
    std::cout << seconds << " s\n";
    EXPECT_EQ(constraints.size(), slave.points.size());
    EXPECT_LT(seconds, 30.);
  }

  TEST(NodeToFace, Errors)
  {
    std::mt19937 random(8);
    const ContactSurface slave = square({1, false}, 2, random, {}, {1., 0., 0.}, {0., 1., 0.}, 1.),
                         away = square({1, false}, 2, random, {3., 0., 0.});
    EXPECT_THROW(node_to_face_constraints(slave, away), taut::UserError);
    EXPECT_THROW(node_to_segment_constraints(slave, away), taut::UserError);
    EXPECT_THROW(mortar_constraints(slave, away), taut::UserError);
  }
} // namespace
