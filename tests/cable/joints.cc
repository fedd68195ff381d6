// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: links that turn hold two places of one cable together, and ball joints of solids and
// masses hold one place. Source: the same cable as two joined bodies, and the messages.
#include "cable/errors_of_runs.h"

namespace
{
  using namespace verification;
  using namespace taut;

  std::string part_of_cable(const std::string &name, const std::string &ends,
                            const std::string &length, const std::string &elements)
  {
    return "Body " + name + ": Type = cable; " + ends + "; Unstressed length = " + length +
           "; Axial stiffness = 1e5; Mass per length = 1; Axial damping = 50; Largest strain = 1; "
           "Element = bar; Elements = " +
           elements + "\n";
  }

  std::string scene(const std::string &bodies_and_links)
  {
    return "Gravity = 0, -9.81; Start = equilibrium\nTime: End = 0.5; Step = 5e-3\n" +
           bodies_and_links;
  }

  /// A link from s = 6 to 18 m of a slack cable of 24 m, which something pulls at 3 m.
  std::string between(const std::string &link, const bool is_one)
  {
    const std::string first = is_one ? "whole" : "first", second = is_one ? "whole" : "second",
                      network = "Load pull: On = " + first +
                                " @ 3, 0; Direction = 0.3, 1, 0.5; Magnitude = 60*sin(5*t)\n"
                                "Link link: Turns = true; From = " +
                                first + " @ 6, 0; To = " + second +
                                (is_one ? " @ 18, 0" : " @ 6, 0") + "; " + link + "\n";
    if (is_one)
      return scene(part_of_cable("whole", "To = 20, 0", "24", "16") + network);
    return scene(part_of_cable("first", "To = 10, -5; Held ends = from", "12", "8") +
                 part_of_cable("second", "From = 10, -5; To = 20, 0; Held ends = to", "12", "8") +
                 network +
                 "Link middle: Type = ball joint; From = first @ 12, 0; To = second @ 0, 0\n");
  }
} // namespace

TEST(CableJoints, a_link_between_two_places_of_one_cable)
{
  for (const std::string link :
       {"Type = dropper; Length = 7", "Type = dropper; Length = 7; Stiffness = 4e3",
        "Type = joint; Length = 10", "Type = stop; Length = 11.5; Stiffness = 4e3"})
  {
    std::vector<double> force[2];
    for (const bool is_one : {false, true})
      run_scene(between(link, is_one), {},
                [&](const StepView &view) {
                  force[is_one].push_back(view.state.multiplier[view.constraints.index_of_link(0)]);
                });
    const double size = largest(force[0]), error = largest_difference(force[0], force[1]);
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
    {
      const std::string name = bodies.empty() ? "Body left" : "Body right";
      bodies +=
          name + ": Type = solid; Dimension = 3; Young's modulus = 1e6; Density = 10\n" + name +
          "/Mesh: Generator = subdivided_hyper_rectangle; Arguments = 2, 1, 2 : " + corners + "\n";
    }
    return error_of("Start = undeformed\nTime: End = 0\n" + bodies +
                    "Mass lamp: Position = 4, 1; Motions = x, y, z; Mass = 1\n"
                    "Link pin: Type = ball joint; From = " +
                    first + "; To = " + to);
  };
  EXPECT_EQ(joined("left @ 2, 1, 0", "right @ 2, 1, 0"), "");
  expect(joined("left @ 2, 1, 0", "right @ 2, 0.9969, 0"),
         {"Link pin/To", "0.0031 m apart", "From is at 2, 1, 0", "To at 2, 0.9969, 0",
          "start from 'equilibrium'", "thousandth of the shorter body"});
  EXPECT_EQ(joined("right @ 4, 1, 0", "lamp"), "");
  expect(joined("right @ 4, 0, 0", "lamp"), {"Link pin/To", "1 m apart"});
}

TEST(CableJoints, ball_joints_of_masses_hold_one_place)
{
  const auto joined = [](const std::string &place, const std::string &to)
  {
    std::string masses;
    for (const std::string name : {"a", "b"})
      masses += "Mass " + name + ": Position = " + (name == "a" ? "3, 4" : place) +
                "; Motions = x, y, z; Mass = 1\n";
    return error_of("Start = given\nTime: End = 0\n" + masses +
                    "Link tie: Type = ball joint; From = a; To = " + to);
  };
  // Up to a billionth of the distance from the origin places are the same where nothing is at rest.
  EXPECT_EQ(joined("3, 4.000000004", "b"), "");
  expect(joined("3, 4.00000004", "b"), {"Link tie/To", "4e-08 m apart"});
  expect(joined("3, 4.00004", "b"), {"Link tie/To", "4e-05 m apart", "start from 'equilibrium'"});
  expect(joined("3, 4, 0.01", "b"),
         {"Link tie/To", "0.01 m apart", "From is at 3, 4, 0", "To at 3, 4, 0.01"});
  EXPECT_EQ(joined("0, 0", "ground @ 3, 4"), "");
  expect(joined("0, 0", "ground @ 0, 0"), {"Link tie/To", "5 m apart"});
}

// A cable of 50 m between two bodies above each other, of which the upper one moves by (1 - cos 4
// t) / 4. Expected: the mass on a spring EA / L with a third of the mass of the cable, from rest.
TEST(CableJoints, vertical_cable_between_bodies)
{
  const std::string scene = R"(Generator = network; Gravity = 0, -9.81; Start = equilibrium
Body rope: Type = cable; From = 0, 50; To = 0, 0; Unstressed length = 50; Axial stiffness = 1e8
Body rope: Mass per length = 0.5; Element = bar; Elements = 10; Held ends = none
Mass tip: Position = 0, 50; Motions = z; Mass = 1; Prescribed y = 0.25*(1-cos(4*t)); Prescribed x = 0
Mass load: Position = 0, 0; Motions = x, y; Mass = 1000
Link upper: Type = ball joint; From = rope @ 0, 0; To = tip
Link lower: Type = ball joint; From = rope @ 50, 0; To = load
Probe load: Point = load
Probe middle: Point = rope @ 25, 0; Direction = 1, 0
Time: Step = 1e-3; End = 1
)";
  const double omega = std::sqrt(1e8 / 50. / (1000. + 25. / 3.)),
               R = 1. / (1. - 16. / (omega * omega));
  // The other way round as ANCF.
  const Overrides turned = {"Body rope/From=0, 0", "Body rope/To=0, 50", "Body rope/Element=ANCF",
                            "Network/Link upper/From=rope @ 50, 0",
                            "Network/Link lower/From=rope @ 0, 0"};
  for (const Overrides &overrides : {Overrides(), turned})
  {
    double rest = 0., error = 0., beside = 0.;
    run_scene(scene, overrides,
              [&](const StepView &step)
              {
                const double t = step.state.time;
                if (t == 0.)
                  rest = step.probes[0];
                const double y = .25 * (1. - R * std::cos(4. * t) + (R - 1.) * std::cos(omega * t));
                error = std::max(error, std::fabs(step.probes[0] - rest - y));
                beside = std::max(beside, std::fabs(step.probes[1]));
              });
    figure("mass below a vertical cable, error of its place", error, "m");
    EXPECT_LT(error, 2e-3);
    EXPECT_LT(beside, 1e-8);
  }
}

// The start closes what a ball joint is apart. Expected: the mass is where the end of its cable
// hangs, 2.9 mm lower, and stretches that by 98.1 N over 1e6 N and the weight of the cable.
TEST(CableJoints, ball_joint_offset)
{
  for (const double apart : {2.9e-3, -1.3e-3})
  {
    const double length = 3. + apart, EA = 1e6, weight = .01 * 9.81 * length;
    double sunk = 0., gap = 1.;
    verification::run_scene(
        "Gravity = 0, -9.81, 0; Start = equilibrium\nTime: End = 0\n"
        "Body c: Type = cable; From = 0, 3; To = 0, 0; Axial stiffness = 1e6; Mass per length = "
        "0.01; Elements = 4; Element = bar; Held ends = from; Unstressed length = " +
            verification::number(length) +
            "\nMass m: Position = 0, 0; Motions = x, y, z; Mass = 10\n"
            "Link j: Type = ball joint; From = c @ " +
            verification::number(length) + ", 0; To = m\n",
        {},
        [&](const StepView &view)
        {
          sunk = -verification::displacement(view, verification::point_of_mass(view, 0));
          gap = verification::largest(view.state.distance);
        });
    EXPECT_NEAR(sunk, apart + (98.1 + .5 * weight) / EA * length, 1e-7);
    EXPECT_LT(gap, 1e-12);
  }
}
