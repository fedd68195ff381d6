// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the scenes of cables in prm/ have the numbers, closed forms, that their heads expect.
#include "cable/places_in_steps.h"
#include "verification/scene_tests.h"

using verification::run_scene;
using verification::scene_file;

TEST(CableScenes, weight_on_a_slack_cable)
{
  run_scene(scene_file("hanging_cable"), {},
            [](const taut::StepView &step) {
              EXPECT_NEAR(moved(step, step.scene.probes[0].point, {0., -1.}), 1.04526, 1e-5);
            });
}

TEST(CableScenes, wind)
{
  run_scene(scene_file("cable_in_wind"), {},
            [](const taut::StepView &step)
            {
              const double expected[] = {765.92227, 249.81399, -248.76864};
              for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(step.state.multiplier[i], expected[i], 1e-4);
            });
}

TEST(CableScenes, snap)
{
  double largest = 0., at = 0.;
  run_scene(scene_file("snap_load"), {},
            [&](const taut::StepView &step)
            {
              if (step.state.multiplier[0] > largest)
              {
                largest = step.state.multiplier[0];
                at = step.state.time;
              }
            });
  EXPECT_NEAR(largest, 4.3231 * 500., .02 * 2161.5);
  EXPECT_NEAR(at, .05, .002);
}

TEST(CableScenes, elastica)
{
  run_scene(scene_file("elastica"), {},
            [](const taut::StepView &step)
            {
              const taut::Attachment &tip = step.scene.probes[0].point;
              EXPECT_NEAR(moved(step, tip, {0., -1.}), .8106, 2e-4);
              EXPECT_NEAR(moved(step, tip, {-1., 0.}), .5550, 2e-4);
            });
}

TEST(CableScenes, plucked)
{
  const auto deepest = [](const verification::Overrides &entries)
  {
    double y = 0.;
    run_scene(scene_file("plucked_cable"), entries,
              [&](const taut::StepView &step) {
                y = std::min(y, moved(step, step.scene.probes[0].point, {0., 1.}));
              });
    return y;
  };
  const double ancf = deepest({"Body cable/Elements=64", "Time/Step=1e-3"}),
               bar = deepest({"Body cable/Elements=64", "Body cable/Element=bar",
                              "Body cable/Bending stiffness=0", "Time/Step=1e-3"});
  // 512 equal elements, without short ones beside the load, have -.1297 and, linearised, -.1352.
  EXPECT_NEAR(ancf, -.1297, 1e-4);
  EXPECT_NEAR(bar, ancf, 1e-3 * .1297); // it does not bend
  EXPECT_NEAR(deepest({}), ancf, 1e-3 * .1297);
  EXPECT_NEAR(deepest({"Body cable/Geometry=linearised"}), -.1352, 2e-4);
}

TEST(CableScenes, pendulum)
{
  double below = 0., farthest = 0., height = 0., x = 0., t = 0., pull = 0.;
  int n = 0;
  run_scene(scene_file("pendulum_cable"), {},
            [&](const taut::StepView &step)
            {
              const taut::Attachment &mass = step.scene.probes[0].point;
              const double now = moved(step, mass, {1., 0.});
              if (x > 0. && now <= 0.)
                below = t + (step.state.time - t) * x / (x - now);
              if (now < farthest)
              {
                farthest = now;
                height = moved(step, mass, {0., 1.}) - 10.001;
              }
              if (std::fabs(now) < 1.)
              {
                pull += std::fabs(step.state.multiplier[1]);
                ++n;
              }
              x = now;
              t = step.state.time;
            });
  EXPECT_NEAR(below, 1.872, .01);
  EXPECT_NEAR(farthest, -10., .02);
  EXPECT_NEAR(height, 0., .3); // flat there: 10 mm of x are 250 mm of y
  EXPECT_NEAR(pull / n, 3. * 10. * 9.81, 8.);
}

TEST(CableScenes, floor)
{
  double lifted = 0., at_start = 0.;
  unsigned int most_iterations = 0; // of all solves of a step
  run_scene(scene_file("cable_on_floor"), {},
            [&](const taut::StepView &step)
            {
              most_iterations = std::max(most_iterations, step.residuals.iterations);
              const std::vector<double> &N = step.state.multiplier;
              if (step.state.time == 0.)
                at_start = std::accumulate(N.begin(), N.end(), 0.);
              lifted = std::max(lifted, moved(step, step.scene.probes[0].point, {0., 1.}));
              for (const double gap : step.state.complementarity_gap)
                EXPECT_GE(gap, -1e-12);
            });
  EXPECT_NEAR(at_start, 535.5, 3.);
  EXPECT_GE(most_iterations, 5u);
  EXPECT_GT(lifted, 12. - 10.1); // from its own shape to the floor is 10.1 m
}

// BDF2 begins with a step of backward Euler, whose gain of energy is measured, and measures none.
TEST(CableScenes, certificates_are_of_their_own_steps)
{
  std::vector<double> gains;
  run_scene(scene_file("pendulum_cable"), {"Time/Scheme = BDF2", "Time/End = .05"},
            [&](const taut::StepView &step) { gains.push_back(step.report.gain()); });
  ASSERT_EQ(gains.size(), 6u);
  EXPECT_NE(gains[1], 0.);
  for (std::size_t i = 2; i < gains.size(); ++i)
    EXPECT_EQ(gains[i], 0.) << i;
}
