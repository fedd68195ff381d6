// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the check of steps compares what a user looks at: rotations, the motion of a mass relative
// to its base, what redundant links do together; and it is silent where nothing moves. Source: the
// phase of an oscillator, rest, the momentum of a box.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// What the log says of the error of places [1]; -1: nothing.
  double reported(const std::string &log)
  {
    const std::string mark = "Steps: error of places ";
    const std::size_t at = log.find(mark);
    return at == std::string::npos ? -1. : .01 * std::stod(log.substr(at + mark.size()));
  }

  const std::string turning =
      "Gravity = 0, 0; Start = given\n"
      "Mass m: Motions = rotation; Mass = 1; Inertia = 0.5; Initial velocity = 0, 0, 2\n"
      "Spring k: To = m; Rotational = true; Stiffness = 5000\nTime: Step = 5e-3; End = 1\n";
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

TEST(CheckedSteps, a_mass_at_rest_has_no_error)
{
  for (const std::string mass : {"3", "1e-3", "1e5"})
  {
    const std::string log =
        log_of("Mass m: Motions = y; Mass = " + mass +
               "\nLink s: Type = stop; From = ground; To = m; Direction = 0, 1\n"
               "Time: Step = 1e-3; End = 1\n");
    EXPECT_EQ(reported(log), 0.) << log;
    EXPECT_FALSE(has(log, "Warning")) << log;
  }
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
