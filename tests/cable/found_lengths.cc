// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: lengths of droppers that hang from cables are found, so that what they hold stands at the
// prescribed height. Expected values: two bars under a force; distances of displaced places.
#include "cable/errors_of_runs.h"
#include "cable/places_in_steps.h"

using verification::g;

namespace
{
  using namespace taut;

  constexpr double span = 20.;

  /// A messenger cable 1 m above a string, with droppers at these places.
  std::string line(const std::string &messenger, const std::string &at_cable,
                   const std::string &at_wire)
  {
    return R"(Gravity = 0, -9.81; Start = equilibrium
Body messenger: Type = cable; From = 0, 1, 0; To = 20, 1, 0; )" +
           messenger + R"(
Wire contact: From = 0, 0; To = 20, 0; Components = string; Tension = 2000; Mass per length = 1
Support ends: Wire = contact; Positions = 0, 20
Link hanger: Type = dropper; From = messenger @ )" +
           at_cable + "; To = contact @ " + at_wire +
           R"(; Direction = 0, -1; Find length = true; Axial stiffness = 1e5
Time: End = 0
)";
  }

  struct Found
  {
    std::vector<double> length, force, height, distance;
  };

  Found find(const std::string &scene, const verification::Overrides &overrides = {})
  {
    Found result;
    const auto record = [&](const StepView &view)
    {
      result = {{}, view.state.multiplier, {}, {}};
      for (const Link &link : view.scene.links)
      {
        result.length.push_back(link.length);
        result.height.push_back(displaced(view, link.to).y);
        result.distance.push_back(displaced(view, link.from).y - result.height.back());
      }
    };
    verification::run_scene(scene, overrides, record);
    return result;
  }
} // namespace

// A cable without weight between its ends and a dropper in the middle is two bars.
TEST(FoundLengths, under_two_bars)
{
  constexpr double EA = 1e6, length = 19.98, V = span / 2. * g;
  const auto holds_less = [&](const double d)
  {
    const double l = std::hypot(span / 2., d), T = EA * (l / (length / 2.) - 1.);
    return 2. * T * d / l < V;
  };
  const std::string bars =
      "Unstressed length = 19.98; Axial stiffness = 1e6; Element = bar; Elements = 4";
  const Found found = find(line(bars, "9.99, 0", "10"));
  ASSERT_EQ(found.length.size(), 1u);
  EXPECT_NEAR(found.force[0], V, 1e-9 * V);
  EXPECT_NEAR(found.length[0], 1. - verification::end_of(0., 2., holds_less), 1e-9);
  EXPECT_NEAR(found.height[0], 0., 1e-9);
}

// Also one that sags by several times the way to the wire: of 21 m it would lie 2 m below.
TEST(FoundLengths, under_cables_with_weight)
{
  const std::string weight = "Axial stiffness = 1e6; Mass per length = 1";
  for (const std::string shape : {"Sag = 0.2", "Horizontal tension = 3e3"})
    for (const std::string geometry : {"nonlinear", "linearised"})
    {
      const std::string scene =
          line(weight + "; " + shape + "; Geometry = " + geometry, "4, 0; 9, 0; 15, 0", "4, 9, 15");
      const Found found = find(scene, {"Network/Link hanger/Prescribed displacement=0.02"});
      ASSERT_EQ(found.length.size(), 3u);
      for (std::size_t i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(found.height[i], .02, 1e-9) << shape << geometry;
        EXPECT_NEAR(found.distance[i], found.length[i], 1e-9) << shape << geometry;
        EXPECT_GT(found.force[i], 0.);
      }
    }
  expect(error_of(line(weight + "; Unstressed length = 21", "10, 0", "10")),
         {"Network/Link hanger", "would have no length"});
}

// The wire that is held may be a cable, too: its displacement counts from its own shape at rest.
TEST(FoundLengths, of_what_holds_a_cable)
{
  const std::string weight = "Axial stiffness = 1e6; Mass per length = 1; Sag = 0.1",
                    lower =
                        "Body lower: Type = cable; From = 0, 0, 0; To = 20, 0, 0; " + weight + "\n";
  const Found found = find(line(weight, "10, 0", "10") + lower,
                           {"Bodies=messenger, lower", "Network/Link hanger/To=lower @ 10, 0",
                            "Network/Link hanger/Prescribed displacement=0.05"});
  ASSERT_EQ(found.length.size(), 1u);
  EXPECT_NEAR(found.height[0], -.05, 1e-4); // 0.1 m of sag, less 0.05 m
  EXPECT_NEAR(found.distance[0], found.length[0], 1e-9);
}
