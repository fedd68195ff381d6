// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a rigid joint that starts open is refused, for it would close within one step of any
// length; one that is closed but for rounding, elastic or at rest is taken. Expected values: the
// messages; the place where a joint holds.
#include "scene_tests.h"

using namespace verification;

namespace
{
  const std::string pendulum = R"(Gravity = 0, -9.81; Start = given
Mass m: Position = 0, -1; Motions = x, y; Mass = 2
Link rod: Type = joint; From = ground @ 0, 0; To = m
Time: End = 0.02; Step = 1e-3
)";

  /// Height of the mass over its place at the end; the message of the error.
  double height(const Overrides &overrides, std::string *error = nullptr)
  {
    double y = 0.;
    try
    {
      run_scene(pendulum, overrides,
                [&](const taut::StepView &view)
                { y = displacement(view, point_of_mass(view, 0)); });
    }
    catch (const taut::EntryError &e)
    {
      EXPECT_TRUE(error) << e.message();
      if (error)
        *error = e.entry() + ": " + e.message();
    }
    return y;
  }

  const std::string rod = "Network/Link rod/";
} // namespace

TEST(OpenJoints, are_refused_at_the_start)
{
  for (const Overrides &open :
       {Overrides{rod + "Gap=0.1"}, Overrides{rod + "Gap=-1e-6"},
        Overrides{"Network/Mass m/Initial displacement=0, 0.01, 0"},
        Overrides{rod + "Turns=true", rod + "Length=1.1"},
        Overrides{rod + "Turns=true", "Network/Mass m/Initial displacement=0, 0.01, 0"}})
    for (const std::string start : {"given", "undeformed"})
    {
      if (start == "undeformed" && open.back().find("Initial") != std::string::npos)
        continue;
      Overrides entries = open;
      entries.push_back("Start=" + start);
      std::string error;
      height(entries, &error);
      for (const char *const part :
           {"Network/Link rod: joint 'rod' starts with a gap of ", "give it a Stiffness"})
        EXPECT_TRUE(has(error, part)) << open.back() << ": " << error;
    }
}

TEST(OpenJoints, are_closed_but_for_rounding_or_at_rest)
{
  const std::string lifted = "Network/Mass m/Initial displacement=0, 0.1, 0";
  EXPECT_NEAR(height({}), 0., 1e-12);
  EXPECT_NEAR(height({rod + "Gap=0.1", lifted}), .1, 1e-12);
  EXPECT_NEAR(height({rod + "Gap=0.10000000001", lifted}), .1, 1e-9);
  EXPECT_NEAR(height({rod + "Turns=true", rod + "Length=1.0000000001"}), 0., 1e-9);
  EXPECT_NEAR(height({rod + "Turns=true", rod + "Length=0.9", lifted}), .1, 1e-9);
  EXPECT_NEAR(height({rod + "Gap=0.1", "Start=equilibrium"}), .1, 1e-12);
  EXPECT_GT(height({rod + "Gap=0.1", rod + "Stiffness=1e3"}), 0.);
}
