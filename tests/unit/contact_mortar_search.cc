// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: mortar constraints find what faces what on curves, around corners, between whole
// boundaries and among ten thousand edges, balance forces and moments there, and say what is wrong
// with a surface. Expected: closed forms of circles and blocks.
#include "common.h"
#include "contact_meshes.h"

#include <taut/solid/contact_constraints.h>

namespace
{
  using namespace contact_meshes;
  using taut::mortar_constraints;

  /// Arcs with a gap: forces balance to rounding, moments to force times gap and angle of an edge.
  TEST(Mortar, CurvedInterfaces)
  {
    std::mt19937 random(7);
    for (const unsigned int degree : {1u, 2u})
      for (const double distance : {0., .01})
        for (const bool lower_is_slave : {true, false})
        {
          const auto arc = [](const double r) {
            return [r](double s) { return Coordinates{-r * std::cos(s), r * std::sin(s), 0.}; };
          };
          const ContactSurface inner =
              on_curve(random_grid(24, .2, 2.2, random), degree, arc(1.), true, random);
          const ContactSurface outer =
              on_curve(random_grid(17, .5, 2.6, random), degree, arc(1. + distance), false, random);
          const ContactSurface &slave = lower_is_slave ? inner : outer,
                               &master = lower_is_slave ? outer : inner;
          const Constraints constraints = mortar_constraints(slave, master);
          Coordinates force;
          double moment = 0., scale = 0.;
          std::uniform_real_distribution<double> any(0., 1.);
          for (const SurfaceConstraint &c : constraints)
          {
            const double n = any(random) * c.area;
            scale += n;
            for (const auto &w : c.slave)
            {
              force = add_scaled(force, n, w.weight);
              moment += n * cross(slave.points[w.node], w.weight).z;
            }
            for (const auto &w : c.master)
            {
              force = add_scaled(force, n, w.weight);
              moment += n * cross(master.points[w.node], w.weight).z;
            }
            // A chord of 2 / 24 to 2 / 8 is h^2 / 8 off its arc.
            EXPECT_NEAR(c.gap, distance, degree == 1 ? 8e-3 : 2e-4);
            EXPECT_GT(c.area, 0.);
          }
          EXPECT_LT(norm(force), exact);
          EXPECT_LT(std::fabs(moment), scale * (degree == 1 ? 1e-3 : 2e-5));
          EXPECT_NEAR(total_area(constraints), 1.7 * (lower_is_slave ? 1. : 1. + distance), 5e-3);
          // Uniform pressure on the edges of the slave that are covered: consistent loads.
          if (degree == 1 && lower_is_slave)
          {
            const Vectors load =
                forces(constraints, &SurfaceConstraint::slave, slave.points.size(), 1.);
            Vectors expected(slave.points.size());
            std::vector<bool> inside(slave.points.size(), true);
            for (const auto &face : slave.faces)
            {
              const Coordinates t = slave.points[face[1]] - slave.points[face[0]];
              Coordinates down = {.5 * t.y, -.5 * t.x, 0.};
              if (dot(down, slave.points[face[0]]) > 0.)
                down = times(-1., down);
              for (const unsigned int i : face)
              {
                expected[i] = add_scaled(expected[i], 1., down);
                for (const unsigned int k : face)
                {
                  const double s = std::atan2(slave.points[k].y, -slave.points[k].x);
                  inside[i] = inside[i] && s > .52 && s < 2.18;
                }
              }
            }
            for (std::size_t i = 0; i < load.size(); ++i)
              EXPECT_TRUE(!inside[i] || norm(load[i] - expected[i]) < exact);
          }
        }
  }

  /// A block in a corner: each side sees its own wall, without averaging around the corner.
  TEST(Mortar, Corners)
  {
    std::mt19937 random(8);
    const auto bend = [](const double s) {
      return s < 0. ? Coordinates{0., -s, 0.} : Coordinates{s, 0., 0.};
    };
    const ContactSurface block = on_curve({-1., -.6, -.3, 0., .2, .7, 1.}, 1, bend, false, random);
    const auto upright = [](const double s) { return Coordinates{-.01, -s, 0.}; };
    ContactSurface wall = on_curve({-1., -.4, 0.}, 1, upright, true, random);
    append(wall, on_curve({0., .5, 1.}, 1, level(-.01), true, random));
    const Constraints constraints = mortar_constraints(block, wall);
    EXPECT_EQ(constraints.size(), 7u);
    EXPECT_NEAR(total_area(constraints), 2., exact);
    for (const SurfaceConstraint &c : constraints)
      EXPECT_NEAR(c.gap, .01, exact);
  }

  /// A plate above a floor: its top sees no floor, its bottom sees the nearer of two.
  TEST(Mortar, BacksAndNearestFaces)
  {
    std::mt19937 random(9);
    ContactSurface plate = on_curve({0., .5, 1.}, 1, level(0.), false, random);
    append(plate, on_curve({0., .5, 1.}, 1, level(.05), true, random));
    ContactSurface floor = on_curve({-1., 2.}, 1, level(-.3), true, random);
    append(floor, on_curve({.5, 2.}, 1, level(.01), true, random));
    for (unsigned int order = 0; order < 2; ++order)
    {
      const Constraints constraints = mortar_constraints(plate, floor);
      EXPECT_NEAR(total_area(constraints), 1., exact);
      double integral = 0.;
      for (const SurfaceConstraint &c : constraints)
      {
        integral += c.area * c.gap;
        EXPECT_LT(c.normal.y, 0.);
      }
      EXPECT_NEAR(integral, .5 * .3 - .5 * .01, exact);
      std::swap(floor.faces[0], floor.faces[1]);
      std::swap(floor.outward[0], floor.outward[1]);
    }
  }

  /// Two blocks on each other, each with its whole boundary, and sides flush: only the interface.
  TEST(Mortar, WholeBoundaries)
  {
    std::mt19937 random(14);
    // Along four sides of unit length.
    const auto around = [](const double low, const double high)
    {
      return [low, high](const double s)
      {
        const double x = std::clamp(s < 2. ? s : 3. - s, 0., 1.),
                     y = std::clamp(s < 2. ? s - 1. : 4. - s, 0., 1.);
        return Coordinates{x, low + (high - low) * y, 0.};
      };
    };
    const ContactSurface lower = on_curve({0., .3, .7, 1., 1.4, 2., 2.2, 2.9, 3., 3.5, 4.}, 1,
                                          around(-.6, 0.), false, random);
    for (const double distance : {.1, 0., -.05})
    {
      const ContactSurface upper = on_curve({0., .45, 1., 1.4, 2., 2.8, 3., 3.5, 4.}, 1,
                                            around(distance, .5 + distance), false, random);
      for (const bool lower_is_slave : {true, false})
      {
        const Constraints constraints =
            lower_is_slave ? mortar_constraints(lower, upper) : mortar_constraints(upper, lower);
        EXPECT_NEAR(total_area(constraints), 1., exact);
        for (const SurfaceConstraint &c : constraints)
          EXPECT_NEAR(c.gap, distance, exact);
      }
    }
  }

  TEST(Mortar, TenThousandFacesInSeconds)
  {
    std::mt19937 random(10);
    const auto line = [](const double s) { return Coordinates{s, .6 * s, 0.}; };
    const ContactSurface slave =
        on_curve(random_grid(10000, 0., 1., random), 1, line, true, random);
    const ContactSurface master =
        on_curve(random_grid(12000, 0., 1., random), 1, line, false, random);
    Constraints constraints;
    const double seconds = seconds_of([&] { constraints = mortar_constraints(slave, master); });
    std::cout << seconds << " s\n";
    EXPECT_NEAR(total_area(constraints), std::hypot(1., .6), 1e-12);
    EXPECT_LT(seconds, 30.);
  }

  std::string error_between(const ContactSurface &slave, const ContactSurface &master,
                            const double t = 1., const double distance = 0.)
  {
    return verification::error_of([&] { mortar_constraints(slave, master, t, distance); });
  }

  TEST(Mortar, Errors)
  {
    std::mt19937 random(11);
    const ContactSurface lower = on_curve({0., 1.}, 1, level(0.), true, random),
                         upper = on_curve({0., 1.}, 1, level(.5), false, random),
                         turned = on_curve({0., 1.}, 1, level(.5), true, random),
                         beside = on_curve({2., 3.}, 1, level(.5), false, random);
    EXPECT_EQ(error_between(lower, upper), "");
    const auto expect = [](const std::string &text, const std::string &part)
    { EXPECT_TRUE(verification::has(text, part)) << text; };
    expect(error_between(lower, upper, 1., .1),
           "within 0.1 m; the smallest distance between them is "
           "about 0.5 m");
    expect(error_between(lower, turned), "no face of the first faces the second");
    expect(error_between(lower, beside), "'lower' and 'upper': no face");
    expect(error_between(lower, upper, 0.), "thickness");
    expect(error_between(lower, upper, 1., -1.), "search distance is -1");
    const std::pair<std::function<void(ContactSurface &)>, std::string> spoils[] = {
        {[](ContactSurface &s) { s.faces[0][1] = 7; }, "'lower': face 0 at ("},
        {[](ContactSurface &s) { s.faces[0][1] = 7; }, "names node 7 of 2"},
        {[](ContactSurface &s) { s.points[1] = s.points[0]; }, "has no area"},
        {[](ContactSurface &s) {
           s.outward[0] = {1., 0., 0.};
         },
         "outward direction along the face"},
        {[](ContactSurface &s) { s.degree = 2; }, "has 2 nodes, which no face of degree 2 has"},
        {[](ContactSurface &s) { s.faces = {}, s.outward = {}; }, "has no faces"},
        {[](ContactSurface &s) { s.points[0].x = std::nan(""); }, "no number"},
        {[](ContactSurface &s) { s.dim = 3; }, "no face of degree 1 has"}};
    for (const auto &[spoil, part] : spoils)
    {
      ContactSurface wrong = lower;
      spoil(wrong);
      expect(error_between(wrong, upper), part);
      expect(error_between(upper, wrong), part);
    }
  }
} // namespace
