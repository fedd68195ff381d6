// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the log of a static equilibrium names the bodies that nothing holds, and no others.
// Source: the supports and links of each scene.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// A bar and beam of 4 m without loads, and the lines of the log that speak of free bodies.
  std::string free_bodies(const std::string &names, const std::string &items)
  {
    Session session(R"(Gravity = 0, 0
)" + names + R"(
Wire beam: To = 4, 0; Components = bar, beam; Mass per length = 1; Axial stiffness = 1e5;
  Bending stiffness = 500; Element size = 0.5
)" + items,
                    {"Time.End=0", "Output.Field interval=0"});
    session.run([](const taut::StepView &) {});
    std::istringstream log(session.log());
    std::string found;
    for (std::string line; std::getline(log, line);)
      if (line.find("nothing holds") != std::string::npos)
        found += line;
    return found;
  }

  const std::string foot = "Support foot: Wire = beam; Motion = axial\n";
  const std::string hinge = "Support hinge: Wire = beam\n";
  std::string link(const std::string &name, const std::string &type, const std::string &more)
  {
    return "Link " + name + ": Type = " + type +
           "; From = ground; Direction = 0, 1; Stiffness = 1e5; " + more + "\n";
  }
} // namespace

TEST(FreeBodies, without_any_support)
{
  EXPECT_EQ(free_bodies("", ""),
            "  nothing holds 'beam (axial)', 'beam (transverse)': at rest only "
            "because no force moves them");
}

TEST(FreeBodies, one_condition_does_not_hold_a_beam)
{
  EXPECT_EQ(free_bodies("", foot + hinge),
            "  nothing holds 'beam (transverse)': at rest only because no force moves it");
}

TEST(FreeBodies, a_second_support_or_a_joint_does)
{
  EXPECT_EQ(free_bodies("", foot + hinge + link("joint", "joint", "To = beam @ 3")), "");
  EXPECT_EQ(free_bodies("", foot + "\nSupport hinge: Wire = beam; Positions = 0, 4\n"), "");
}

TEST(FreeBodies, an_open_stop_does_not)
{
  EXPECT_EQ(free_bodies("", foot + hinge + link("stop", "stop", "To = beam @ 3; Gap = 0.01")),
            "  nothing holds 'beam (transverse)': at rest only because no force moves it");
}

TEST(FreeBodies, a_mass_that_is_joined_to_a_free_body_is_free_with_it)
{
  EXPECT_EQ(
      free_bodies("", foot + R"(
Mass block: Position = 2, -1; Mass = 3; Motions = y
Link joint: Type = joint; From = block; To = beam @ 2; Stiffness = rigid
)"),
      "  nothing holds 'beam (transverse)', 'block': at rest only because no force moves them");
}
