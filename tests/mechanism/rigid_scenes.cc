// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: scenes of rigid bodies in prm/ have the numbers, closed forms, that their heads expect.
#include "verification/scene_tests.h"

#include <taut/mechanism/rigid_body.h>

namespace
{
  using namespace verification;

  std::vector<double> displacement(const taut::StepView &step, const std::size_t k)
  {
    std::vector<double> U = step.reference.displacement[k];
    for (std::size_t i = 0; i < U.size(); ++i)
      U[i] += step.state.U[k][i];
    return U;
  }
} // namespace

TEST(RigidBodyScenes, bar_on_two_cables)
{
  double passes = 0., farthest = -2., turns = 0., before = 0., t = 0., first = 0., lowest = 1.;
  bool is_start = true;
  run_scene(scene_file("bar_on_two_cables"), {},
            [&](const taut::StepView &step)
            {
              for (std::size_t k = 0; k < step.structure.size(); ++k)
              {
                const auto *body = dynamic_cast<const taut::RigidBody *>(&step.structure[k]);
                if (!body)
                  continue;
                const std::vector<double> U = displacement(step, k);
                const double angle = body->rotation(U).y, height = body->centre(U).y;
                EXPECT_LE(body->deformation(U), 1e-12);
                if (is_start)
                {
                  EXPECT_NEAR(angle, -1.0471, 1e-4);
                  first = height;
                }
                is_start = false;
                lowest = std::min(lowest, height);
                if (passes == 0. && angle >= 0.)
                  passes = t + (step.state.time - t) * before / (before - angle);
                if (step.state.time < 2. && angle > farthest)
                {
                  farthest = angle;
                  turns = step.state.time;
                }
                before = angle;
                t = step.state.time;
              }
            });
  EXPECT_NEAR(passes, .7836 + .005, 1e-3);
  EXPECT_NEAR(farthest, 1.0471, 1e-3);
  EXPECT_NEAR(turns, 1.5673 + .005, .0051);
  EXPECT_NEAR(first - lowest, .0808, 5e-4);
}

// The multipliers of its conditions are rounding, and no motion whose error shortens steps.
TEST(RigidBodyScenes, a_body_that_flies_straight_takes_long_steps)
{
  int n_steps = 0;
  run_scene(R"(Generator = network; Start = given
Body bar: Type = rigid body; Mass = 2; Moments of inertia = 1, 2, 2.5; Velocity = 1, 2, 3
Time: End = 1; Step = 1e-2; Step control = adaptive
)",
            {}, [&](const taut::StepView &) { ++n_steps; });
  EXPECT_LE(n_steps, 101);
}
