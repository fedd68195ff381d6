// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a tensioned beam without load that its supports move as a rigid body is at rest on a
// straight line, however many parts it is cut in, with each form of the interface operator. All
// slopes and moments of its cuts are rounding there or cancel. Source: w(s) = u0 + (u1 - u0) s / L.
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
