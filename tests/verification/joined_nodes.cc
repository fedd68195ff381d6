// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a node at a rigid stop keeps its mass where a second wire is joined to it, or a mass by a
// joint that is stiffer than its elements, and the motion is right.
// Source: BDF2, which redistributes no mass, with a sixteenth of the step.
#include "scene_tests.h"

using namespace verification;

namespace
{
  std::string bar(const std::string &name, const std::string &length, const std::string &mass,
                  const std::string &stiffness)
  {
    return "Wire " + name + ": From = 0, 0; To = 0, " + length +
           "; Components = bar; Mass per length = " + mass + "; Axial stiffness = " + stiffness +
           "; Element size = 0.25; Initial axial velocity = -1\n";
  }

  /// A bar that falls on its end, with what is joined to it there.
  std::string scene(const std::string &other = "", const std::string &joint = "")
  {
    return "Gravity = 0, 0; Start = given\nTime: Step = 1e-3; End = 0.3\n" +
           bar("bar", "10", "1", "10000") +
           "Link floor: Type = stop; From = ground; To = bar @ 0; Direction = 0, 1; Gap = 0.05\n" +
           other +
           (joint.empty()
                ? ""
                : "Link joint: Type = joint; To = bar @ 0; Direction = 0, 1; " + joint + "\n");
  }

  std::string with_wire(const std::string &mass, const std::string &stiffness)
  {
    return scene(bar("other", "6", mass, stiffness), "From = other @ 0");
  }

  std::string with_mass(const double stiffness)
  {
    return scene(
        "Mass block: Position = 0, 0; Motions = y; Mass = 5; Initial velocity = 0, -1, 0\n",
        "From = block; Stiffness = " + number(stiffness));
  }

  struct Motion
  {
    std::vector<double> places; ///< at the end, of four places along the bar [m]
    double impulse = 0., lowest = 0.;
    std::string log;
  };
  Motion run(const std::string &text, const Overrides &overrides)
  {
    Motion result;
    Session session(text, overrides);
    double last = 0.;
    session.run(
        [&](const taut::StepView &view)
        {
          result.impulse += view.state.multiplier[0] * (view.state.time - last);
          last = view.state.time;
          result.places.clear();
          for (const double s : {0., 3., 6., 10.})
            result.places.push_back(displacement(view, 0, s, {0., 1.}));
          result.lowest = std::min(result.lowest, result.places[0]);
        });
    result.log = session.log();
    return result;
  }

  /// Both runs within 2 % of the way there and back.
  void compare(const std::string &name, const std::string &text, const double step)
  {
    const Motion chosen = run(text, {"Time.Step=" + number(step)}),
                 fine = run(text, {"Time.Step=" + number(step / 16.), "Time.Scheme=BDF2"});
    double off = 0., way = 0.;
    for (std::size_t i = 0; i < fine.places.size(); ++i)
    {
      raise(off, chosen.places[i] - fine.places[i]);
      way = std::max(way, .05 + std::fabs(fine.places[i] + .05));
    }
    figure(name + ", error of the motion over its way", off / way);
    figure(name + ", error of the impulse", std::fabs(chosen.impulse / fine.impulse - 1.));
    EXPECT_FALSE(has(chosen.log, "gave their mass")) << chosen.log;
    EXPECT_FALSE(has(fine.log, "gave their mass")) << fine.log;
    EXPECT_TRUE(has(chosen.log, "Scheme (automatic): Moreau-Jean")) << chosen.log;
    EXPECT_GE(chosen.lowest, -.05 - 1e-9);
    EXPECT_LT(off, .02 * way) << name;
    EXPECT_NEAR(chosen.impulse, fine.impulse, .02 * fine.impulse) << name;
  }
} // namespace

// The test can fail: nothing is joined to the node.
TEST(JoinedNodes, a_node_alone_gives_its_mass)
{
  const Motion motion = run(scene(), {});
  EXPECT_TRUE(has(motion.log, "under 'floor' gave their mass")) << motion.log;
}

TEST(JoinedNodes, with_a_second_wire_keep_their_mass)
{
  compare("bar with one of twice its mass", with_wire("2", "20000"), 1e-3);
  compare("bar with one of its own mass, half as fast", with_wire("1", "2500"), 1e-3);
}

// 2.5 and 25 times as stiff as the element of the bar.
TEST(JoinedNodes, with_a_stiff_joint_keep_their_mass)
{
  compare("bar with 5 kg on 1e5 N/m", with_mass(1e5), 1e-3);
  compare("bar with 5 kg on 1e6 N/m", with_mass(1e6), 2.5e-4);
}
