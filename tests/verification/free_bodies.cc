// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the log of a static equilibrium names the bodies that nothing holds, and no others.
// Source: the supports and links of each scene.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// A bar and beam of 4 m without loads, and the lines of the log that speak of free bodies.
  std::string free_bodies(const std::string &items)
  {
    std::istringstream log(log_of(R"(Gravity = 0, 0
Wire beam: To = 4, 0; Components = bar, beam; Mass per length = 1; Axial stiffness = 1e5;
  Bending stiffness = 500; Element size = 0.5
)" + items,
                                  {"Time.End=0", "Output.Field interval=0"}));
    std::string found;
    for (std::string line; std::getline(log, line);)
      if (has(line, "nothing holds"))
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

TEST(FreeBodies, are_those_that_supports_and_links_leave_free)
{
  const std::string free_beam =
      "  nothing holds 'beam (transverse)': at rest only because no force moves it";
  EXPECT_EQ(free_bodies(""), "  nothing holds 'beam (axial)', 'beam (transverse)': at rest only "
                             "because no force moves them");
  // One condition does not hold a beam; a second support or a joint does, an open stop does not.
  EXPECT_EQ(free_bodies(foot + hinge), free_beam);
  EXPECT_EQ(free_bodies(foot + hinge + link("joint", "joint", "To = beam @ 3")), "");
  EXPECT_EQ(free_bodies(foot + "\nSupport hinge: Wire = beam; Positions = 0, 4\n"), "");
  EXPECT_EQ(free_bodies(foot + hinge + link("stop", "stop", "To = beam @ 3; Gap = 0.01")),
            free_beam);
  // A mass that is joined to a free body is free with it.
  EXPECT_EQ(
      free_bodies(foot + R"(
Mass block: Position = 2, -1; Mass = 3; Motions = y
Link joint: Type = joint; From = block; To = beam @ 2; Stiffness = rigid
)"),
      "  nothing holds 'beam (transverse)', 'block': at rest only because no force moves them");
}

// A link between two places of one body holds it nowhere; a rope over pulleys holds what hangs on
// it.
TEST(FreeBodies, are_those_that_links_that_turn_leave_free)
{
  EXPECT_EQ(free_bodies("Support s: Wire = beam; Positions = 0, 4\n"
                        "Link tie: Type = joint; Turns = true; From = beam @ 1; To = beam @ 3\n"),
            "  nothing holds 'beam (axial)': at rest only because no force moves it");
  const std::string held = foot + hinge + "Support end: Wire = beam; Positions = 4\n";
  std::string weights;
  for (const auto &[name, place] : {std::pair("a", "-1, -1"), {"b", "0, -0.57735"}, {"c", "1, -1"}})
    weights +=
        std::string("Mass ") + name + ": Position = " + place + "; Mass = 1; Motions = x, y\n";
  const std::string ropes =
      "Gravity = 0, -9.81\nLink rope: Type = dropper; Turns = true; From = a; "
      "Through = ground @ -1, 0, b, ground @ 1, 0; To = c; Length = 4.3094\n";
  EXPECT_EQ(free_bodies(held + weights + ropes), "");
}
