// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the check of steps compares what a user looks at: rotations, the motion of a mass relative
// to its base, what redundant links do together; and it is silent where nothing moves. Source: the
// phase of an oscillator, rest, the momentum of a box.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// What the log says of an error [1]; -1: nothing.
  double reported(const std::string &log, const std::string &mark = "Steps: error of places ")
  {
    const std::size_t at = log.find(mark);
    return at == std::string::npos ? -1. : .01 * std::stod(log.substr(at + mark.size()));
  }

  const std::string turning =
      "Gravity = 0, 0; Start = given\n"
      "Mass m: Motions = rotation; Mass = 1; Inertia = 0.5; Initial velocity = 0, 0, 2\n"
      "Spring k: To = m; Rotational = true; Stiffness = 5000\nTime: Step = 5e-3; End = 1\n";

  /// The check finds a scene right to rounding.
  void expect_no_error(const std::string &scene)
  {
    const std::string log = log_of(scene);
    EXPECT_EQ(reported(log), 0.) << log;
    EXPECT_FALSE(has(log, "Warning")) << log;
  }
} // namespace

// 0.02 sin 100 t in twelve steps a period.
TEST(CheckedSteps, a_rotation_counts_like_a_place)
{
  double error = 0.;
  const std::string log =
      log_of(turning, {},
             [&](const taut::StepView &view)
             { raise(error, view.state.U[0][0] - .02 * std::sin(100. * view.state.time)); });
  EXPECT_GT(figure("mass that turns in twelve steps a period, error", error / .02), 1.);
  EXPECT_GT(figure("the same, error that the log has", reported(log)), .5 * error / .02);
  EXPECT_TRUE(has(log, "Warning: the step is too long")) << log;
}

TEST(CheckedSteps, a_torsional_stop_is_checked)
{
  const std::string log = log_of(
      turning + "Link s: Type = stop; From = ground; To = m; Rotational = true; Gap = 0.01;\n"
                "  Stiffness = 2e5\n");
  EXPECT_GT(reported(log), .02) << log;
  EXPECT_TRUE(has(log, "Warning: the step is too long")) << log;
}

// A base that moves by 10 mm in a slow ramp carries a mass that vibrates by 0.1 mm in ten steps a
// period.
TEST(CheckedSteps, a_mass_is_measured_by_its_motion_on_the_base)
{
  const std::string log =
      log_of("Gravity = 0, 0; Start = given\n"
             "Mass base: Position = 0, -1; Motions = x; Mass = 1e-3; Prescribed y = 1e-2*t\n"
             "Mass m: Motions = y; Mass = 1; Initial velocity = 0, 2e-2, 0\n"
             "Spring k: From = base; To = m; Stiffness = 1e4\nTime: Step = 6e-3; End = 1\n");
  EXPECT_GT(reported(log), .5) << log;
}

// Steps of up to sixteen times 1 ms are right to 0.03 % of places, and energies lie between those
// at their ends.
TEST(CheckedSteps, energies_inside_of_long_steps_are_compared_at_their_times)
{
  const std::string log = log_of("Gravity = 0, 0; Start = given\n"
                                 "Mass base: Position = 0, -1; Motions = x; Mass = 1e-3;\n"
                                 "  Prescribed y = 1e-3*sin(20*t)\n"
                                 "Mass m: Motions = y; Mass = 25; Initial velocity = 0, -0.01, 0\n"
                                 "Spring k: From = base; To = m; Stiffness = 650\n"
                                 "Time: Step control = adaptive; Step = 1e-3; End = 0.6\n");
  EXPECT_LT(reported(log), 5e-4) << log;
  EXPECT_LT(reported(log, "of energies "), .01) << log;
  EXPECT_FALSE(has(log, "Warning")) << log;
}

// Its velocity ends at once, and leaves a motion of the rounding of this velocity.
TEST(CheckedSteps, a_mass_that_is_pressed_to_a_stop_has_no_error)
{
  expect_no_error("Gravity = 0, 0; Start = given\n"
                  "Mass m: Motions = y; Mass = 6.84; Initial velocity = 0, -1.48, 0\n"
                  "Spring k: To = m; Stiffness = 4.6e4\n"
                  "Link s: Type = stop; From = ground; To = m; Direction = 0, 1\n"
                  "Time: Step = 2.2e-3; End = 0.32\n");
}

// So does a load that grows from nothing.
TEST(CheckedSteps, a_load_that_presses_a_mass_to_a_stop_moves_nothing)
{
  expect_no_error(
      "Gravity = 0, 0; Start = given\n"
      "Mass a: Motions = y; Mass = 2.1\nMass b: Position = 0, 1; Motions = y; Mass = 1.23\n"
      "Spring s: To = a; Stiffness = 812\nSpring q: From = a; To = b; Stiffness = 357\n"
      "Link stop: Type = stop; From = ground; To = a; Direction = 0, 1\n"
      "Load l: On = a; Magnitude = -18*t\nTime: Step = 7e-3; End = 0.21\n");
}

TEST(CheckedSteps, a_mass_at_rest_has_no_error)
{
  for (const std::string mass : {"3", "1e-3", "1e5"})
    expect_no_error("Mass m: Motions = y; Mass = " + mass +
                    "\nLink s: Type = stop; From = ground; To = m; Direction = 0, 1\n"
                    "Time: Step = 1e-3; End = 1\n");
}

// Four legs on three motions: how they share an impulse is not known, their sum is.
TEST(CheckedSteps, legs_of_a_box_share_an_impulse)
{
  const std::string log = log_of(
      "Gravity = 0, -9.81; Start = given\n"
      "Body box: Type = rigid body; Mass = 10; Centre = 0, 0.25, 0; Moments of inertia = 0.5, 0.6, "
      "0.4\n"
      "Link legs: Type = stop; From = ground; Direction = 0, 1; Gap = 0.1;\n"
      "  To = box @ -0.3, 0, -0.2; 0.3, 0, -0.2; 0.3, 0, 0.2; -0.3, 0, 0.2\n"
      "Time: Step = 1e-3; End = 2\nTime/Moreau-Jean: Restitution = 0.5\n");
  EXPECT_FALSE(has(log, "the impulse of 'legs")) << log;
}

// Three stops of other directions on a mass that turns: each impulse is known, though they are on
// the same motions, and the sum of all is right at any step.
TEST(CheckedSteps, stops_of_other_directions_share_nothing)
{
  const std::string scene =
      "Gravity = 0, -9.81; Start = given\n"
      "Mass m: Motions = x, y, rotation; Mass = 0.7603; Inertia = 0.07603;\n"
      "  Initial velocity = 1.1692, -2.8927, 1.8605\n"
      "Link a: Type = stop; From = ground; To = m @ 0.33287, -0.035751; Gap = 0.17259;\n"
      "  Direction = -0.071997, 0.9974\n"
      "Link b: Type = stop; From = ground; To = m @ 0.39016, -0.24131; Gap = 0.16476;\n"
      "  Direction = 0.40547, 0.91411\n"
      "Link c: Type = stop; From = ground; To = m @ 0.30752, 0.31931; Gap = 0.17594;\n"
      "  Direction = -0.011422, 0.99993\nTime: End = 0.325622\n";
  double impulse = 0.;
  const auto run = [&](const std::string &step)
  {
    impulse = 0.;
    return log_of(scene, {"Time/Step=" + step},
                  [&](const taut::StepView &view)
                  { impulse += view.state.multiplier[0] * view.state.last_step; });
  };
  run("4e-5");
  const double right = figure("first of three stops on a mass, impulse", impulse, "N s");
  const std::string coarse = run("12.5e-3");
  EXPECT_GT(figure("the same in steps of 12.5 ms, error", std::fabs(impulse / right - 1.)), .02);
  EXPECT_TRUE(has(coarse, "Warning: the step is too long: the impulse of 'a'")) << coarse;
  const std::string fine = run("1e-3");
  EXPECT_LT(figure("the same in steps of 1 ms, error", std::fabs(impulse / right - 1.)), .02);
  EXPECT_FALSE(has(fine, "Warning")) << fine;
}

// A stiff stop a little before a rigid one, and a soft one on another mass: each has an impulse of
// its own, of which the step gets a tenth wrong.
TEST(CheckedSteps, stops_of_their_own_share_nothing)
{
  const std::string log =
      log_of("Gravity = 0, 0; Start = given\n"
             "Mass a: Motions = y; Mass = 2.65; Initial velocity = 0, -99.8, 0\n"
             "Mass b: Position = 0, 48.1; Motions = y; Mass = 4.91; Initial velocity = 0, -214, 0\n"
             "Spring k: From = a; To = b; Stiffness = 456\n"
             "Link rigid: Type = stop; From = ground; To = a; Direction = 0, 1; Gap = 4.64\n"
             "Link stiff: Type = stop; From = ground; To = a; Direction = 0, 1; Gap = 4.55;\n"
             "  Stiffness = 3.36e6\n"
             "Link soft: Type = stop; From = ground; To = b; Direction = 0, 1; Gap = 0.352;\n"
             "  Stiffness = 24.4\n"
             "Time: Step = 2.31e-4; End = 0.105567\n");
  EXPECT_TRUE(has(log, "Warning: the step is too long: the impulse of ")) << log;
}

// A bar hits a wall with nodes that gave their mass away: places of their own are no motion of a
// scheme, and the impulse is exact, 200 N s.
TEST(CheckedSteps, a_wave_of_mass_reduced_nodes_is_no_error)
{
  for (const Overrides &mass : {Overrides{"Network/Wire bar/Mass matrix=reduced"},
                                Overrides{"Time/Mass redistribution=mass"}})
    for (const char *const step : {"5e-4", "1e-4"})
    {
      Session session(TAUT_PRM_FOLDER "/bar_on_wall.prm",
                      mass + Overrides{"Time/Scheme=automatic", std::string("Time/Step=") + step});
      double impulse = 0.;
      session.run([&](const taut::StepView &view)
                  { impulse += view.state.multiplier[0] * view.state.last_step; });
      EXPECT_NEAR(figure("impulse of a bar on a wall", impulse, "N s"), 200., 1.);
      EXPECT_FALSE(has(session.log(), "Warning: the step is too long")) << session.log();
      EXPECT_LT(reported(session.log()), 5e-3);
      EXPECT_GE(reported(session.log()), 0.);
    }
}

TEST(CheckedSteps, a_long_adaptive_run_has_an_estimate)
{
  double error = 0.;
  const std::string log =
      log_of("Gravity = 0, 0; Start = given\n"
             "Mass m: Motions = y; Mass = 1; Initial velocity = 0, 1, 0\n"
             "Spring k: To = m; Stiffness = 100\n"
             "Time: Step = 0.01; End = 1000; Step control = adaptive\n",
             {},
             [&](const taut::StepView &view)
             { raise(error, view.state.U[0][0] - .1 * std::sin(10. * view.state.time)); });
  EXPECT_GT(figure("adaptive run of 1000 s, error", error / .1), 1.);
  EXPECT_GT(figure("the same, error that the log has", reported(log)), .1);
  EXPECT_TRUE(has(log, "Take a Tolerance of about")) << log;
}
