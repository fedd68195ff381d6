// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: impacts with restitution in one step are simultaneous ones, which keep momentum and, with
// e = 1, energy; impacts that steps tell apart follow one after the other; the log says which it
// was. Expected values: Newton's law for each contact or for all at once.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// Newton's cradle: five equal masses along x, the first with 1 m/s, 10 mm from the second; the
  /// others apart by a gap [m].
  std::string cradle(const double gap)
  {
    const std::string names = "abcde";
    std::string text = "Gravity = 0, 0; Start = given\nTime: End = 0.1; Step = 1e-4\n"
                       "Time/Moreau-Jean: Restitution = 1\n";
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      text += std::string("Mass ") + names[i] + ": Position = " + std::to_string(i) +
              ", 0; Motions = x, y; Mass = 1" + (i == 0 ? "; Initial velocity = 1, 0, 0\n" : "\n");
      if (i > 0)
        text += std::string("Link ") + names[i - 1] + names[i] +
                ": Type = stop; Direction = 1, 0; From = " + names[i - 1] + "; To = " + names[i] +
                "; Gap = " + number(i == 1 ? .01 : gap) + "\n";
    }
    return text;
  }

  struct Outcome
  {
    std::vector<double> velocity; ///< along x, of each mass [m/s]
    std::string log;
  };

  Outcome outcome_of(const std::string &scene, const Overrides &overrides = {})
  {
    Outcome result;
    result.log = log_of(
        scene, overrides,
        [&](const taut::StepView &view)
        {
          result.velocity.clear();
          for (std::size_t i = 0; i < view.scene.masses.size(); ++i)
            result.velocity.push_back(evaluate(point_of_mass(view, i, {1., 0.}), view.state.V));
        });
    return result;
  }

  void expect_velocities(const Outcome &outcome, const std::vector<double> &expected)
  {
    ASSERT_EQ(outcome.velocity.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(outcome.velocity[i], expected[i], 1e-12) << i;
  }
} // namespace

// All gaps but the first are far below a step of motion, 0.1 mm: Newton's law for all contacts,
// with the approach of each, 1, 0, 0, 0, has v_b - v_a = 1, v_b = v_c = v_d = v_e. Conditions on
// velocities alone are those of contacts that were closed.
TEST(SimultaneousImpacts, are_those_of_one_step)
{
  const Overrides velocities = {"Time.Scheme=Moreau-Jean",
                                "Time.Moreau-Jean.Conditions=velocities"};
  for (const double gap : {0., 1e-12, 1e-7})
    for (const Overrides &scheme : {Overrides(), velocities})
    {
      const Outcome outcome = outcome_of(cradle(gap), scheme);
      const bool is_sequence = gap > 0. && !scheme.empty();
      if (is_sequence)
        expect_velocities(outcome, {0., 0., 0., 0., 1.});
      else
        expect_velocities(outcome, {-.6, .4, .4, .4, .4});
      for (const char *const text :
           {"Impacts: in 1 step at t = 0.0101 s", "'ab', 'bc', 'cd', 'de', contacts that share"})
        EXPECT_EQ(outcome.log.find(text) == std::string::npos, is_sequence) << gap << outcome.log;
    }
}

// Each mass gives its velocity to the next one.
TEST(SimultaneousImpacts, are_none_where_steps_tell_them_apart)
{
  const Outcome outcome = outcome_of(cradle(.01));
  expect_velocities(outcome, {0., 0., 0., 0., 1.});
  EXPECT_FALSE(has(outcome.log, "Impacts:")) << outcome.log;
}

// The first mass also presses on a floor and hits it at the same time; lumped masses have no
// inertia between x and y.
TEST(SimultaneousImpacts, need_a_body_that_shares_them)
{
  const std::string floor =
      "Link floor: Type = stop; From = ground; To = a; Direction = 0, 1; Gap = 0.01\n";
  const Outcome outcome =
      outcome_of(cradle(.01) + floor, {"Network.Mass a.Initial velocity=1, -1, 0"});
  expect_velocities(outcome, {0., 0., 0., 0., 1.});
  EXPECT_FALSE(has(outcome.log, "Impacts:")) << outcome.log;
}

TEST(SimultaneousImpacts, are_not_named_without_restitution)
{
  const Outcome outcome = outcome_of(cradle(0.), {"Time.Moreau-Jean.Restitution=0"});
  expect_velocities(outcome, {.2, .2, .2, .2, .2});
  EXPECT_FALSE(has(outcome.log, "Impacts:")) << outcome.log;
}

// A mass that only lies on two stops has rates of rounding, and forces of its weight.
TEST(SimultaneousImpacts, are_none_at_rest)
{
  std::string scene = "Gravity = 0, -9.81; Start = undeformed\nTime: End = 0.1; Step = 1e-3\n"
                      "Time/Moreau-Jean: Restitution = 0.5\n"
                      "Mass a: Position = 0, 0; Motions = x, y; Mass = 7\n";
  for (const std::string side : {"l", "r"})
    scene += "Link " + side +
             ": Type = stop; From = ground; To = a; Direction = " + (side == "l" ? "0.3" : "-0.3") +
             ", 1\n";
  const Outcome at_rest = outcome_of(scene, {"Time/Allow energy gain=true"});
  EXPECT_FALSE(has(at_rest.log, "Impacts:")) << at_rest.log;
  const Outcome falls = outcome_of(scene, {"Network/Link l/Gap=0.01", "Network/Link r/Gap=0.01"});
  EXPECT_TRUE(has(falls.log, "'l', 'r', contacts that share")) << falls.log;
}

// A ball and a mass that its spring holds back reach their floors in one step. The spring's energy
// limits the rebound of the mass, and nothing connects it with that of the ball.
TEST(SimultaneousImpacts, balls_that_nothing_connects_bounce_as_alone)
{
  const std::string
      head = "Gravity = -9.81, 0; Start = given\nTime: End = 0.3; Step = 1e-3\n"
             "Time/Moreau-Jean: Restitution = 1\n",
      ball = "Mass ball: Position = 0, 0; Motions = x; Mass = 1; "
             "Initial velocity = -1, 0, 0\n"
             "Link floor: Type = stop; From = ball; To = ground; Direction = -1, 0; Gap = 0.0067\n",
      held = "Mass held: Position = 0, 1; Motions = x; Mass = 1; "
             "Initial velocity = -1, 0, 0\n"
             "Link spring: Type = joint; From = held; To = ground; Direction = 1, 0; "
             "Stiffness = 3e4\n"
             "Link rest: Type = stop; From = held; To = ground; Direction = -1, 0; Gap = 0.0055\n";
  const Outcome alone = outcome_of(head + ball), slow = outcome_of(head + held),
                together = outcome_of(head + ball + held);
  ASSERT_EQ(together.velocity.size(), 2u);
  EXPECT_GT(std::fabs(alone.velocity[0] + 1. + 9.81 * .3), .1);
  EXPECT_NEAR(together.velocity[0], alone.velocity[0], 1e-12);
  EXPECT_NEAR(together.velocity[1], slow.velocity[0], 1e-12);
}
