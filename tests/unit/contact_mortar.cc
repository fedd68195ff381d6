// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: dual mortar constraints in the plane pass the patch test on any overlap, reproduce linear
// gaps, and leave rigid motions alone. Expected: integrals of shape functions, values of the gap.
#include "common.h"
#include "contact_meshes.h"

#include <taut/solid/contact_constraints.h>

namespace
{
  using namespace contact_meshes;
  using taut::mortar_constraints;

  constexpr double thickness = .7, pressure = 3.;
  const double overlaps[] = {1e-6, 1e-4, .01, .06, .15, .3, .49, .51, .8, .999, 1.};

  /// Two straight surfaces on one line, the lower one from 0 to 1.
  struct Pair
  {
    Coordinates origin = {.3, -.2, 0.}, direction;
    ContactSurface lower, upper;
    double begin = 0., end = 1.; ///< of the overlap
    double last = 0.;            ///< length of the edge that is overlapped in part
  };

  /// @p sliver: the upper surface covers this part of the last edge of the lower one and nothing
  /// else; otherwise it covers this part of the first edge and all others.
  Pair straight_pair(const unsigned int degree, const unsigned int other_degree, const double angle,
                     const double part, const bool sliver, std::mt19937 &random)
  {
    Pair pair;
    pair.direction = {std::cos(angle), std::sin(angle), 0.};
    const auto line = [&pair](const double s)
    { return add_scaled(pair.origin, s, pair.direction); };
    const std::vector<double> grid = random_grid(5, 0., 1., random);
    pair.lower = on_curve(grid, degree, line, true, random);
    pair.last = sliver ? grid[5] - grid[4] : grid[1] - grid[0];
    pair.begin = (sliver ? 1. : grid[1]) - part * pair.last;
    pair.upper =
        on_curve(random_grid(7, pair.begin, 1.4, random), other_degree, line, false, random);
    return pair;
  }

  void expect_patch(const Pair &pair, const bool lower_is_slave)
  {
    const ContactSurface &slave = lower_is_slave ? pair.lower : pair.upper,
                         &master = lower_is_slave ? pair.upper : pair.lower;
    const Constraints constraints = mortar_constraints(slave, master, thickness);
    // Out of the lower body.
    const Coordinates up = {-pair.direction.y, pair.direction.x, 0.};
    const Coordinates on_slave = times((lower_is_slave ? -1. : 1.) * pressure * thickness, up);
    const auto loads = [&](const ContactSurface &surface, const Coordinates &load)
    { return consistent_loads(surface, pair.origin, pair.direction, pair.begin, pair.end, load); };
    const Vectors of_slave = loads(slave, on_slave),
                  of_master = loads(master, times(-1., on_slave));
    EXPECT_LT(error_of_forces(constraints, &SurfaceConstraint::slave, of_slave, pressure), exact);
    EXPECT_LT(error_of_forces(constraints, &SurfaceConstraint::master, of_master, pressure), exact);
    EXPECT_NEAR(total_area(constraints), (pair.end - pair.begin) * thickness, exact);
    for (const SurfaceConstraint &c : constraints)
    {
      EXPECT_GT(c.area, 0.);
      EXPECT_NEAR(norm(c.normal), 1., exact);
      EXPECT_NEAR(c.gap, 0., exact);
      Coordinates sum;
      for (const auto &side : {c.slave, c.master})
        for (const taut::NodeWeight &w : side)
          sum = add_scaled(sum, 1., w.weight);
      EXPECT_LT(norm(sum), exact);
    }
  }

  const auto rest = [](const Coordinates &) { return Coordinates(); };

  TEST(Mortar, PatchTestOnAnyOverlap)
  {
    std::mt19937 random(1);
    for (const unsigned int degree : {1u, 2u})
      for (const unsigned int other_degree : {1u, 2u})
        for (const double angle : {0., .7, 2.5, -1.57})
          for (const double part : overlaps)
            for (const bool sliver : {false, true})
              for (unsigned int repeat = 0; repeat < 3; ++repeat)
              {
                SCOPED_TRACE("degrees " + std::to_string(degree) + " " +
                             std::to_string(other_degree) + " angle " + std::to_string(angle) +
                             " part " + std::to_string(part) + " sliver " + std::to_string(sliver));
                const Pair pair = straight_pair(degree, other_degree, angle, part, sliver, random);
                expect_patch(pair, true);
                expect_patch(pair, false);
              }
  }

  /// A punch inside one edge of the slave: both ends of it have a multiplier.
  TEST(Mortar, PunchInsideAnEdge)
  {
    std::mt19937 random(2);
    for (const unsigned int degree : {1u, 2u})
      for (const double width : {.5, .1, 1e-3, 1e-6})
      {
        Pair pair;
        pair.origin = {};
        pair.direction = {1., 0., 0.};
        pair.lower = on_curve({0., 1.}, degree, level(0.), true, random);
        pair.begin = .3;
        pair.end = .3 + width;
        pair.upper = on_curve({.3, .3 + width}, 1, level(0.), false, random);
        expect_patch(pair, true);
        const Constraints constraints = mortar_constraints(pair.lower, pair.upper);
        EXPECT_GE(constraints.size(), 2u);
        EXPECT_NEAR(constraints[0].point.x + constraints.back().point.x, .6 + width,
                    degree == 1 ? exact : width);
        for (const SurfaceConstraint &c : constraints)
          EXPECT_NEAR(c.point.x, .3 + .5 * width, .5 * width + exact);
      }
  }

  /// Two pieces on one edge, with a hole between them, of any widths.
  TEST(Mortar, HolesInsideAnEdge)
  {
    std::mt19937 random(3);
    for (const unsigned int degree : {1u, 2u})
      for (const double width : {.3, 1e-3, 1e-6})
      {
        const ContactSurface slave = on_curve({0., 1., 2.}, degree, level(0.), true, random);
        ContactSurface master = on_curve({.1, .1 + width}, 1, level(0.), false, random);
        append(master, on_curve({.6, 1.8}, 1, level(0.), false, random));
        const Constraints constraints = mortar_constraints(slave, master);
        EXPECT_NEAR(total_area(constraints), width + 1.2, exact);
        const Coordinates down = {0., -1., 0.};
        Vectors expected = consistent_loads(slave, {}, {1., 0., 0.}, .1, .1 + width, down);
        const Vectors more = consistent_loads(slave, {}, {1., 0., 0.}, .6, 1.8, down);
        for (std::size_t i = 0; i < expected.size(); ++i)
          expected[i] = add_scaled(expected[i], 1., more[i]);
        EXPECT_LT(error_of_forces(constraints, &SurfaceConstraint::slave, expected), exact);
        for (const SurfaceConstraint &c : constraints)
          EXPECT_GT(c.area, 0.);
      }
  }

  /// Slave on the line y = 0 from 0 to 1, master on y = f(x) from 1 - ... : D_i is f at the node,
  /// at the outer one f at the end of the overlap.
  TEST(Mortar, MeanGapsOfLinearAndQuadraticGaps)
  {
    std::mt19937 random(4);
    for (const unsigned int degree : {1u, 2u})
      for (const double part : {1e-6, .01, .05, .3, .6, 1.})
      {
        const std::vector<double> grid = random_grid(5, 0., 1., random);
        const ContactSurface slave = on_curve(grid, degree, level(0.), true, random);
        const auto f = [degree](const double x)
        { return .02 + .1 * x + (degree == 2 ? .05 * x * x : 0.); };
        const double begin = grid[1] - part * (grid[1] - grid[0]);
        const ContactSurface master =
            on_curve(random_grid(4, begin, 1.3, random), degree, graph(f), false, random);
        const Constraints constraints = mortar_constraints(slave, master);
        double moment[2] = {};
        for (const SurfaceConstraint &c : constraints)
        {
          const double x = slave.points[c.node].x;
          if (x > grid[1] || (x == grid[1] && part > .1))
          {
            EXPECT_NEAR(c.gap, f(x), exact);
            EXPECT_NEAR(c.point.x, x, exact);
          }
          else if (degree == 1 && part > .1)
          {
            EXPECT_NEAR(c.gap, f(begin), exact);
            EXPECT_NEAR(c.point.x, begin, exact);
          }
          EXPECT_NEAR(c.normal.y, 1., exact);
          moment[0] += c.area * c.gap;
          moment[1] += c.area;
          // The gap is what the weights make of positions.
          const auto place = [](const Coordinates &y) { return y; };
          EXPECT_NEAR(gap(c, slave, master, place, place), 2. * c.gap, exact);
        }
        const auto integral = [&f](const double a, const double b)
        { return (b - a) * (f(a) + 4. * f(.5 * (a + b)) + f(b)) / 6.; };
        EXPECT_NEAR(moment[0], integral(begin, 1.), exact);
        EXPECT_NEAR(moment[1], 1. - begin, exact);
      }
  }

  /// Slivers: the outer node has no constraint of its own, however small; larger overlaps have one.
  TEST(Mortar, ConstraintsOfSliversBecomeOne)
  {
    std::mt19937 random(5);
    for (const unsigned int degree : {1u, 2u})
      for (const double angle : {0., .6, 2.})
        for (const double part : overlaps)
        {
          const Pair pair = straight_pair(degree, 1, angle, part, false, random);
          const std::size_t n = mortar_constraints(pair.lower, pair.upper).size();
          const bool is_sure = part < .05 || part > .1;
          EXPECT_TRUE(!is_sure || n == (part < .05 ? 4 : 5) * degree + 1) << part;
          const Pair alone = straight_pair(degree, 1, angle, part, true, random);
          EXPECT_TRUE(part >= .01 || mortar_constraints(alone.lower, alone.upper).size() == 1u)
              << part;
        }
  }

  /// Rigid motions of both bodies: exact on straight surfaces with a gap.
  TEST(Mortar, RigidMotions)
  {
    std::mt19937 random(6);
    const Coordinates direction = {.8, .6, 0.}, up = {-.6, .8, 0.};
    for (const unsigned int degree : {1u, 2u})
    {
      const auto line = [&](const double height) {
        return [&, height](const double s) { return add_scaled(times(s, direction), height, up); };
      };
      const ContactSurface slave =
          on_curve(random_grid(6, 0., 1., random), degree, line(0.), true, random);
      const ContactSurface master =
          on_curve(random_grid(9, .15, 1.2, random), degree, line(.25), false, random);
      const auto turn = [](const Coordinates &x) { return Coordinates{-x.y, x.x, 0.}; };
      const auto shift = [](const Coordinates &) { return Coordinates{3., -5., 0.}; };
      for (const SurfaceConstraint &c : mortar_constraints(slave, master))
      {
        EXPECT_NEAR(c.gap, .25, exact);
        EXPECT_NEAR(gap(c, slave, master, shift, shift), .25, exact);
        EXPECT_NEAR(gap(c, slave, master, turn, turn), .25, exact);
        // The master turns about the origin: the gap grows with the place along the surface, and
        // (x_m - x_s) . up = s after a turn by one radian, to first order.
        EXPECT_NEAR(gap(c, slave, master, rest, turn) - .25, dot(c.point, direction), exact);
        EXPECT_NEAR(gap(c, slave, master, rest, shift) - .25, dot(shift({}), up), exact);
      }
    }
  }
} // namespace
