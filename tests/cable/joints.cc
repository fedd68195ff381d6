// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: links that turn hold two places of one cable together, and ball joints of solids and
// masses hold one place. Expected values: the same cable as two bodies that are joined in the
// middle, and the messages.
#include "cable/errors_of_runs.h"
#include "verification/run.h"

#include <taut/base/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{
  using namespace taut;
  using verification::figure;
  using verification::Overrides;

  std::string part_of_cable(const std::string &name, const std::string &ends,
                            const std::string &length, const std::string &elements)
  {
    return "subsection Body " + name + "\nset Type = cable\n" + ends +
           "set Unstressed length = " + length +
           "\nset Axial stiffness = 1e5\nset Mass per length = 1\nset Axial damping = 50\nset "
           "Largest strain = 1\n" +
           "set Element = bar\nset Elements = " + elements + "\nend\n";
  }

  std::string scene(const std::string &bodies, const std::string &names, const std::string &network)
  {
    return "set Generator = network\nset Gravity = 0, -9.81\nset Start = equilibrium\n"
           "set Bodies = " +
           names + "\n" + bodies +
           "subsection Time\nset End = 0.5\nset Step = 5e-3\nend\nsubsection Network\n"
           "set Loads = pull\n" +
           network + "end\n";
  }

  /// A link from s = 6 to 18 m of a slack cable of 24 m, which something pulls at 3 m.
  std::string between(const std::string &link, const bool is_one)
  {
    const std::string first = is_one ? "whole" : "first", second = is_one ? "whole" : "second",
                      network = "subsection Load pull\nset On = " + first +
                                " @ 3, 0\nset Direction = 0.3, 1, 0.5\n"
                                "set Magnitude = 60*sin(5*t)\nend\nset Links = link" +
                                (is_one ? "" : ", middle") +
                                "\nsubsection Link link\nset Turns = true\nset From = " + first +
                                " @ 6, 0\nset To = " + second + (is_one ? " @ 18, 0" : " @ 6, 0") +
                                "\n" + link + "end\n";
    if (is_one)
      return scene(part_of_cable("whole", "set To = 20, 0\n", "24", "16"), "whole", network);
    return scene(part_of_cable("first", "set To = 10, -5\nset Held ends = from\n", "12", "8") +
                     part_of_cable("second",
                                   "set From = 10, -5\nset To = 20, 0\nset Held ends = to\n", "12",
                                   "8"),
                 "first, second",
                 network + "subsection Link middle\nset Type = ball joint\nset From = first @ 12, "
                           "0\nset To = second @ 0, 0\nend\n");
  }
} // namespace

TEST(CableJoints, a_link_between_two_places_of_one_cable)
{
  for (const std::string link : {"set Type = dropper\nset Length = 7\n",
                                 "set Type = dropper\nset Length = 7\nset Stiffness = 4e3\n",
                                 "set Type = joint\nset Length = 10\n",
                                 "set Type = stop\nset Length = 11.5\nset Stiffness = 4e3\n"})
  {
    std::vector<double> force[2];
    for (const bool is_one : {false, true})
      verification::run_scene(
          between(link, is_one), {},
          [&](const StepView &view)
          { force[is_one].push_back(view.state.multiplier[view.constraints.index_of_link(0)]); });
    ASSERT_EQ(force[0].size(), force[1].size());
    double size = 0., error = 0.;
    for (std::size_t i = 0; i < force[0].size(); ++i)
    {
      size = std::max(size, std::fabs(force[0][i]));
      error = std::max(error, std::fabs(force[0][i] - force[1][i]));
    }
    EXPECT_GT(size, 10.) << link;
    EXPECT_LT(error, 1e-6 * size) << link;
    figure("force between two places of one cable beside that of two joined cables", error / size);
  }
}

TEST(CableJoints, ball_joints_of_solids_hold_one_place)
{
  const auto joined = [](const std::string &first, const std::string &to)
  {
    std::string bodies;
    for (const char *const corners : {"0, 0, 0 : 2, 1, 2", "2, 0, 0 : 4, 1, 2"})
      bodies += std::string("subsection Body ") + (bodies.empty() ? "left" : "right") +
                "\nset Type = solid\nset Dimension = 3\nset Young's modulus = 1e6\n"
                "set Density = 10\nsubsection Mesh\nset Generator = subdivided_hyper_rectangle\n"
                "set Arguments = 2, 1, 2 : " +
                corners + "\nend\nend\n";
    return error_of("set Generator = network\nset Start = undeformed\nset Bodies = left, right\n" +
                    bodies +
                    "subsection Time\nset End = 0\nend\nsubsection Network\nset Links = pin\n"
                    "set Masses = lamp\nsubsection Mass lamp\nset Position = 4, 1\n"
                    "set Motions = x, y, z\nset Mass = 1\nend\n"
                    "subsection Link pin\nset Type = ball joint\nset From = " +
                    first + "\nset To = " + to + "\nend\nend\n");
  };
  EXPECT_EQ(joined("left @ 2, 1, 0", "right @ 2, 0.9971, 0"), ""); // a diagonal of 3 m
  expect(joined("left @ 2, 1, 0", "right @ 2, 0.9969, 0"),
         {"Link pin/To", "0.0031 m apart", "From is at 2, 1, 0", "To at 2, 0.9969, 0", "to 0.003 m",
          "thousandth of the shorter body"});
  EXPECT_EQ(joined("right @ 4, 1, 0", "lamp"), "");
  expect(joined("right @ 4, 0, 0", "lamp"), {"Link pin/To", "1 m apart", "to 0.003 m"});
}

TEST(CableJoints, ball_joints_of_masses_hold_one_place)
{
  const auto joined = [](const std::string &place, const std::string &to)
  {
    std::string masses;
    for (const std::string name : {"a", "b"})
      masses += "subsection Mass " + name + "\nset Position = " + (name == "a" ? "3, 4" : place) +
                "\nset Motions = x, y, z\nset Mass = 1\nend\n";
    return error_of(
        "set Generator = network\nset Start = given\nsubsection Time\nset End = 0\nend\n"
        "subsection Network\nset Masses = a, b\n" +
        masses + "set Links = tie\nsubsection Link tie\nset Type = ball joint\n" +
        "set From = a\nset To = " + to + "\nend\nend\n");
  };
  EXPECT_EQ(joined("3, 4.000004", "b"), "");
  expect(joined("3, 4, 0.01", "b"), {"Link tie/To", "0.01 m apart", "From is at 3, 4, 0",
                                     "To at 3, 4, 0.01", "from the origin"});
  EXPECT_EQ(joined("0, 0", "ground @ 3, 4"), "");
  expect(joined("0, 0", "ground @ 0, 0"), {"Link tie/To", "5 m apart"});
}
