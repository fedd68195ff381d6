// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a steady arm that is a rigid body holds the contact wire aside by its tension, at the end
// of a circle about its hinge, and moves as a lever with the stiffness of its tension. Sources:
// balance of moments about the hinge; the lever with a spring of tension over length.
#include "scene_tests.h"

using namespace verification;

namespace
{
  constexpr double T = 10000., span = 40., stagger = .25;

  /// Two spans with one arm, without droppers; the arm has 3 kg, 1.2 m aside and 0.3 m up.
  const std::string line_with_arms = R"(Generator = catenary
Start = equilibrium
Catenary: Span lengths = 40, 40; Pantographs =
Catenary/Contact wire: Model = string; Mass per length = 0.1; Tension = 10000; Element size = 1; Stagger = 0, 0.25, 0
Catenary/Messenger wire: Model = string; Mass per length = 0.8; Tension = 12000; Element size = 1
Catenary/Supports: Arm kind = rigid body; Arm mass = 3; Arm reach = 1.2; Arm rise = 0.3
Catenary/Droppers: Positions =
Time: Step = 1e-3; End = 0; Scheme = Moreau-Jean
)";

  double upwards(const taut::StepView &view)
  {
    return displacement(view, 1, span);
  }
  double aside(const taut::StepView &view)
  {
    return displacement(view, 1, span, {0., 0., 1.});
  }
} // namespace

TEST(SteadyArm, a_rigid_body_balances_moments_about_its_hinge)
{
  int n_seen = 0;
  const auto check = [&](const double side)
  {
    return [&n_seen, side](const taut::StepView &view)
    {
      ++n_seen;
      const double y = upwards(view), z = aside(view), down = .3 - y, in = side * 1.45 - z;
      EXPECT_NEAR(std::hypot(down, in), std::hypot(.3, 1.2), 1e-9);
      // Forces of the wire on the clamp, and the weight of the arm at its middle.
      const double Fy = -2. * T * y / span - .1 * g * span, Fz = -2. * T * z / span,
                   moment = -in * (Fy - .5 * 3. * g) + down * Fz;
      EXPECT_NEAR(moment, 0., 1e-6);
      EXPECT_GT(std::fabs(z), .1);
    };
  };
  run_scene(line_with_arms, {}, check(1.));
  // To the other side the hinge is on the other side.
  run_scene(line_with_arms, {"Catenary/Contact wire/Stagger=0, -0.25, 0"}, check(-1.));
  EXPECT_EQ(n_seen, 2);
}

TEST(SteadyArm, small_motions_of_a_rigid_body_are_those_of_a_lever_under_tension)
{
  // A light push runs past a level arm, whose tension is 125 N.
  const std::string pushed = line_with_arms + R"(Gravity = 0, 0
Catenary: Pantographs = push
Catenary/Pantograph push: Masses = 1; Stiffnesses = 0; Dampings = 0; Static force = 0.5; Start = 25; Speed = 100
Time: End = 1
)";
  const auto run = [&](const Overrides &overrides)
  { return history_of(pushed, Overrides{"Catenary/Supports/Arm rise=0"} + overrides, upwards); };
  const double tension = 2. * T * stagger / span;
  const std::vector<double> rigid = run({}),
                            lever =
                                run({"Catenary/Supports/Arm kind=hinged",
                                     "Catenary/Supports/Arm stiffness=" + number(tension / 1.2)}),
                            free = run({"Catenary/Supports/Arm kind=hinged"});
  EXPECT_GT(largest(rigid), 2e-4);
  EXPECT_LE(largest_difference(rigid, lever), 1e-3 * largest(rigid));
  EXPECT_GE(largest_difference(rigid, free), 1e-2 * largest(rigid));
}

TEST(SteadyArm, a_rigid_body_needs_mass_and_reach)
{
  const auto error = [](const std::string &entry)
  { return error_of([&] { Session(line_with_arms, {entry}); }); };
  EXPECT_TRUE(has(error("Catenary/Supports/Arm mass=0"), "needs a positive one"));
  EXPECT_TRUE(has(error("Catenary/Supports/Arm reach=0"), "Arm reach"));
}
