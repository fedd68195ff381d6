// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the log of a static equilibrium names the bodies that nothing holds, and no others.
// Source: the supports and links of each scene.
#include "run.h"

#include <gtest/gtest.h>

using namespace verification;

namespace
{
  /// A bar and beam of 4 m without loads, and the lines of the log that speak of free bodies.
  std::string free_bodies(const std::string &names, const std::string &items)
  {
    Session session("set Generator = network\nset Gravity = 0, 0\nsubsection Network\n" + names +
                        R"(  set Wires = beam
  subsection Wire beam
    set To                = 4, 0
    set Components        = bar, beam
    set Mass per length   = 1
    set Axial stiffness   = 1e5
    set Bending stiffness = 500
    set Element size      = 0.5
  end
)" + items + "end\n",
                    {"Time.End=0", "Output.Field interval=0"});
    session.run([](const taut::StepView &) {});
    std::istringstream log(session.log());
    std::string found;
    for (std::string line; std::getline(log, line);)
      if (line.find("nothing holds") != std::string::npos)
        found += line;
    return found;
  }

  const std::string foot =
      "  subsection Support foot\n    set Wire = beam\n    set Motion = axial\n  end\n";
  const std::string hinge = "  subsection Support hinge\n    set Wire = beam\n  end\n";
  std::string link(const std::string &name, const std::string &type, const std::string &more)
  {
    return "  subsection Link " + name + "\n    set Type = " + type +
           "\n    set From = ground\n    set Direction = 0, 1\n    set Stiffness = 1e5\n" + more +
           "  end\n";
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
  EXPECT_EQ(free_bodies("  set Supports = foot, hinge\n", foot + hinge),
            "  nothing holds 'beam (transverse)': at rest only because no force moves it");
}

TEST(FreeBodies, a_second_support_or_a_joint_does)
{
  EXPECT_EQ(free_bodies("  set Supports = foot, hinge\n  set Links = joint\n",
                        foot + hinge + link("joint", "joint", "    set To = beam @ 3\n")),
            "");
  EXPECT_EQ(free_bodies("  set Supports = foot, hinge\n",
                        foot + "  subsection Support hinge\n    set Wire = beam\n"
                               "    set Positions = 0, 4\n  end\n"),
            "");
}

TEST(FreeBodies, an_open_stop_does_not)
{
  EXPECT_EQ(free_bodies("  set Supports = foot, hinge\n  set Links = stop\n",
                        foot + hinge +
                            link("stop", "stop", "    set To = beam @ 3\n    set Gap = 0.01\n")),
            "  nothing holds 'beam (transverse)': at rest only because no force moves it");
}

TEST(FreeBodies, a_mass_that_is_joined_to_a_free_body_is_free_with_it)
{
  EXPECT_EQ(
      free_bodies("  set Supports = foot\n  set Masses = block\n  set Links = joint\n",
                  foot + "  subsection Mass block\n    set Position = 2, -1\n    set Mass = 3\n"
                         "    set Motions = y\n  end\n"
                         "  subsection Link joint\n    set Type = joint\n    set From = block\n"
                         "    set To = beam @ 2\n    set Stiffness = rigid\n  end\n"),
      "  nothing holds 'beam (transverse)', 'block': at rest only because no force moves them");
}
