// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: rigid bodies come to rest where joints and cables hold them, and what nothing holds is an
// error. Source: equilibrium of forces and moments; the lowest place of a bar on two lines.
#include "mechanism/rigid_body_run.h"

#include <taut/cable/cable.h>

#include <boost/math/tools/minima.hpp>

using verification::g;
using verification::pi;

namespace
{
  using namespace mechanism;
  using namespace taut;

  RigidBodyData bar(const double angle)
  {
    RigidBodyData data;
    data.name = "bar";
    data.mass = 50.;
    data.moments = {.5, 17., 17.};
    const double s = std::sin(angle), c = std::cos(angle);
    data.axes = {{{c, s, 0.}, {-s, c, 0.}, {0., 0., 1.}}};
    data.gravity = {0., -g, 0.};
    return data;
  }

  /// A light cable from the ceiling to a place on the bar, joined to it along x, y and z.
  void hang(OneBody &one, const Coordinates &from, const Coordinates &to, const double length,
            const int number)
  {
    CableData data;
    data.name = "cable " + std::to_string(number);
    data.from = from;
    data.to = to;
    data.length = length / 1.0002;
    data.section = {1e7, 0., 1e-3, 0.};
    data.gravity = {0., -g, 0.};
    data.n_elements = 4;
    data.holds_to = false;
    const std::size_t cable =
        one.system.add(data.name, [&] { return std::make_unique<Cable>(data); });
    for (const Coordinates &axis : {Coordinates{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}})
      one.system.add(Constraint::bilateral("shackle",
                                           one.system.displacement(cable, {data.length}, axis),
                                           one.system.displacement(0, to, axis)));
  }
} // namespace

// From its place to the lowest one, turned by up to 120 degrees.
TEST(RigidBodyStatics, hangs_down_from_a_joint)
{
  for (const double degrees : {-89., -60., -20., 0., 30.})
  {
    SCOPED_TRACE(degrees);
    const double angle = degrees * pi / 180.;
    RigidBodyData data = bar(angle);
    const Coordinates joint = add_scaled({}, -1., data.axes[0]);
    OneBody one(data);
    one.hold(joint);
    const Stepper stepper(one.system);
    const std::vector<double> U = stepper.displacement(0);
    EXPECT_NEAR(one.body->centre(U).x, joint.x, 1e-9);
    EXPECT_NEAR(one.body->centre(U).y, joint.y - 1., 1e-9);
    EXPECT_NEAR(one.body->rotation(U).z, -.5 * pi - angle, 1e-9);
    EXPECT_LE(one.body->deformation(U), 1e-12);
    EXPECT_NEAR(std::fabs(stepper.multiplier(1)), data.mass * g, 1e-9 * data.mass * g);
    EXPECT_NEAR(stepper.multiplier(0), 0., 1e-6 * data.mass * g);
    EXPECT_LE(stepper.residuals().balance, 1e-9);
  }
}

// Its centre is 0.4 m off the middle; lines of 3 m and 2.5 m end 2.2 m apart at the ceiling. With
// the angle of the bar given, both lines taut fix its place; the lowest one is the equilibrium.
TEST(RigidBodyStatics, heavy_bar_on_two_cables)
{
  constexpr double a = 1.4, b = .6, span = 2.2, l1 = 3., l2 = 2.5;
  struct Pose
  {
    double turn = 0.;  ///< of the first line
    Coordinates first; ///< its end
    double angle = 0.; ///< of the bar
    double depth = 0.; ///< of its centre
  };
  const auto pose = [=](const double turn)
  {
    Pose p;
    p.turn = turn;
    p.first = {l1 * std::sin(turn), -l1 * std::cos(turn), 0.};
    const double dx = span - p.first.x, dy = -p.first.y, distance = std::hypot(dx, dy),
                 along = std::atan2(dy, dx),
                 cosine = ((a + b) * (a + b) + distance * distance - l2 * l2) /
                          (2. * (a + b) * distance);
    p.angle = along - std::acos(cosine);
    p.depth = -(p.first.y + a * std::sin(p.angle));
    return p;
  };
  const auto height = [&](const double turn) { return -pose(turn).depth; };
  const Pose exact = pose(boost::math::tools::brent_find_minima(height, -.4, .4, 40).first);
  // Built askew, with cables a little too short for that.
  const Pose built = pose(exact.turn + .15);
  RigidBodyData data = bar(built.angle);
  data.centre = add_scaled(built.first, a, data.axes[0]);
  OneBody one(data);
  hang(one, {0., 0., 0.}, built.first, l1, 1);
  hang(one, {span, 0., 0.}, add_scaled(built.first, a + b, data.axes[0]), l2, 2);
  const Stepper stepper(one.system);
  const std::vector<double> U = stepper.displacement(0);
  EXPECT_NEAR(one.body->rotation(U).z, exact.angle - built.angle, 1e-3);
  EXPECT_NEAR(one.body->centre(U).y, -exact.depth, 1e-3);
  EXPECT_NEAR(one.body->centre(U).x, exact.first.x + a * std::cos(exact.angle), 3e-3);
  EXPECT_NEAR(one.body->rotation(U).x, 0., 1e-9);
  EXPECT_NEAR(std::fabs(stepper.multiplier(1) + stepper.multiplier(4)), data.mass * g,
              1e-9 * data.mass * g);
  EXPECT_NEAR(stepper.multiplier(0) + stepper.multiplier(3), 0., 1e-8 * data.mass * g);
  // The pull of the first line points along it.
  EXPECT_NEAR(stepper.multiplier(0) / stepper.multiplier(1), exact.first.x / exact.first.y, 1e-3);
  EXPECT_LE(one.body->deformation(U), 1e-12);
}

TEST(RigidBodyStatics, nothing_holds_it)
{
  OneBody one(bar(0.));
  const std::string refusal = verification::error_of([&] { Stepper stepper(one.system); });
  EXPECT_TRUE(verification::has(refusal, "body 'bar'")) << refusal;
}
