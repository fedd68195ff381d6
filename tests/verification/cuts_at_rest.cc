// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a tensioned beam without load that its supports move as a rigid body is at rest on a
// straight line, however many parts it is cut in, with each form of the interface operator. All
// slopes and moments of its cuts are rounding there or cancel. Source: w(s) = u0 + (u1 - u0) s / L.
// So is a beam without load beside a string with one, whose droppers are slack. Source: w = F a b /
// (T L) under the force. So are strings that joints join, below slack droppers and above open
// stops.
#include "scene_tests.h"

using namespace verification;

namespace
{
  struct Beam
  {
    double length, tension, bending_stiffness;
    double left, right; ///< displacements of its ends [m]
  };

  std::string scene(const Beam &beam)
  {
    std::ostringstream out;
    out << "Start = equilibrium\nTime: End = 0\nWire beam: To = " << beam.length
        << ", 0; Components = beam; Mass per length = 1; Weight = false; Tension = " << beam.tension
        << "; Bending stiffness = " << beam.bending_stiffness << "; Element size = 0.5\n";
    for (const bool is_left : {true, false})
      out << "Support " << (is_left ? "left" : "right")
          << ": Wire = beam; Positions = " << (is_left ? 0. : beam.length)
          << "; Displacement = " << (is_left ? beam.left : beam.right) << "\n";
    return out.str();
  }

  void expect_straight(const Beam &beam, const std::string &parts, const std::string &form)
  {
    SCOPED_TRACE(parts + " parts, " + form + ", " + number(beam.length) + " m, " +
                 number(beam.tension) + " N, " + number(beam.bending_stiffness) + " N m^2");
    run_scene(
        scene(beam),
        {"Partition/Number of substructures=" + parts, "Solver/Interface operator=" + form},
        [&](const taut::StepView &view)
        {
          EXPECT_GE(view.structure.cut_constraints().size(), 2u);
          const double slope = (beam.right - beam.left) / beam.length,
                       size = std::max(beam.left, beam.right);
          // Of displacements over the length of a beam, beside the tolerance 1e-8 of a run.
          constexpr double tolerance = 1e-9;
          for (const double part : {0., .21, .5, .77, 1.})
          {
            const double s = part * beam.length;
            EXPECT_NEAR(displacement(view, 0, s), beam.left + slope * s, tolerance * size);
            EXPECT_NEAR(displacement(view, 0, s, {0., 0., 1.}, true), slope, tolerance * size);
          }
        });
  }
} // namespace

TEST(CutsAtRest, a_beam_moved_by_its_supports_is_straight)
{
  for (const char *form : {"assembled dense", "assembled sparse", "matrix-free"})
    for (const char *parts : {"2", "3", "5"})
      for (const double length : {10., 50., 100.})
        for (const double tension : {1e3, 2e4})
          for (const double bending_stiffness : {10., 200., 1e4})
          {
            expect_straight({length, tension, bending_stiffness, 0., .01}, parts, form);
            expect_straight({length, tension, bending_stiffness, .0137, .0137}, parts, form);
          }
}

TEST(CutsAtRest, a_wire_without_loads_stays_beside_one_with_a_load)
{
  constexpr double length = 20., place = 6., tension = 1e4, force = -200.,
                   under_force = force * place * (length - place) / (tension * length);
  const std::string text = "Gravity = 0, 0; Start = equilibrium\nTime: End = 0\n"
                           "Wire upper: From = 0, 1; To = 20, 1; Components = string;"
                           " Mass per length = 1; Tension = 1e4; Element size = 1\n"
                           "Wire lower: To = 20, 0; Components = beam; Mass per length = 1;"
                           " Tension = 1e3; Bending stiffness = 500; Element size = 1\n"
                           "Support of upper: Wire = upper; Positions = 0, 20\n"
                           "Support of lower: Wire = lower; Positions = 0, 20\n"
                           "Link dropper: Type = dropper; From = upper @ 1:2:19;"
                           " To = lower @ 1:2:19; Direction = 0, -1\n"
                           "Link stop: Type = stop; From = ground; To = lower @ 1:3:19;"
                           " Direction = 0, 1; Gap = 0.05\n"
                           "Load pull: On = upper @ 6; Direction = 0, 1; Magnitude = -200\n";
  for (const char *form : {"assembled dense", "assembled sparse", "matrix-free"})
    for (const char *parts : {"2", "3", "5", "8"})
    {
      SCOPED_TRACE(std::string(form) + ", " + parts + " parts");
      run_scene(text,
                {std::string("Partition/Number of substructures=") + parts,
                 std::string("Solver/Interface operator=") + form},
                [&](const taut::StepView &view)
                {
                  EXPECT_NEAR(displacement(view, 0, place), under_force, 1e-9);
                  for (const double s : {3., 10., 17.})
                    EXPECT_NEAR(displacement(view, 1, s), 0., 1e-12);
                });
    }
}

TEST(CutsAtRest, joined_wires_without_loads_stay_above_open_stops)
{
  const auto wire = [](const std::string &name, const std::string &y, const std::string &more)
  {
    return "Wire " + name + ": From = 0, " + y + "; To = 40, " + y + "; Mass per length = 1; " +
           more + "\nSupport of " + name + ": Wire = " + name + "; Positions = 0, 40\n";
  };
  const std::string text =
      "Gravity = 0, 0; Start = equilibrium\nTime: End = 0\n" +
      wire("upper", "3",
           "Components = beam; Tension = 1e3; Bending stiffness = 500; Element size = .5") +
      wire("middle", "2", "Components = string; Tension = 1e4; Element size = .5") +
      wire("lower", "1", "Components = string; Tension = 1e3; Element size = 1") +
      "Link dropper: Type = dropper; From = upper @ 1:2:39; To = middle @ 1:2:39; Direction = 0, "
      "-1;"
      " Law = table; Law points = 0.001: 10, 0.01: 500\n"
      "Link joint: Type = joint; From = middle @ 1:1:39; To = lower @ 1:1:39; Direction = 0, -1\n"
      "Link stop: Type = stop; From = ground; To = lower @ 1:3:39; Direction = 0, 1; Gap = 0.001\n"
      "Load pull: On = upper @ 12; Direction = 0, 1; Magnitude = -200\n";
  for (const char *form : {"assembled dense", "assembled sparse", "matrix-free"})
    for (const char *parts : {"2", "3", "6", "8"})
    {
      SCOPED_TRACE(std::string(form) + ", " + parts + " parts");
      run_scene(text,
                {std::string("Partition/Number of substructures=") + parts,
                 std::string("Solver/Interface operator=") + form},
                [&](const taut::StepView &view)
                {
                  EXPECT_LT(displacement(view, 0, 12.), -1.);
                  for (const std::size_t k : {1, 2})
                    for (const double s : {3., 10., 27.})
                      EXPECT_NEAR(displacement(view, k, s), 0., 1e-12);
                });
    }
}
