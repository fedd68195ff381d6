// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the observer 'section forces' has the largest tension, bending moment and stress of a
// wire, with place and time. Sources: q L^2/8 and P L/4 of a hinged beam; of one under a tension T
// the moment (q EI/T) (1 - 1/cosh(L/2 sqrt(T/EI))) at midspan; F in a bar under an axial force F;
// for a force that grows in time, the end of the run.
#include "scene_tests.h"

using namespace verification;

namespace
{

  std::string beam(const std::string &more, const std::string &sections)
  {
    return "Start = equilibrium\nWire beam: From = 2, 0; To = 12, 0; Element size = 0.5; "
           "Mass per length = 2; " +
           more +
           "\nSupport ends: Wire = beam; Positions = 0, 10\nOutput: Observers = section forces\n"
           "Output/section forces: Wires = beam; " +
           sections + "\n";
  }

  nlohmann::json forces_of(const std::string &scene)
  {
    return say(scene).json["observers"]["beam"];
  }
} // namespace

TEST(SectionForces, of_a_beam_under_its_weight)
{
  const double q = 2. * 9.81, h = .5, expected = q * 100. / 8.;
  const auto found = forces_of(
      beam("Components = beam; Bending stiffness = 1e5", "Section areas = 150; Diameters = 14") +
      "Gravity = 0, -9.81\nTime: Step = 1e-2; End = 0.02\n");
  const double M = value(found, "largest_bending_moment");
  EXPECT_NEAR(M, expected, 1.01 * q * h * h / 12.);
  EXPECT_NEAR(value(found, "x_of_the_largest_bending_moment"), 7., 1e-9);
  EXPECT_NEAR(value(found, "largest_stress"), M * 32. / (pi * std::pow(.014, 3)), 1e-3 * M);
}

TEST(SectionForces, of_a_beam_under_tension)
{
  const double q = 2. * 9.81, EI = 195., T = 2e4, b = std::sqrt(T / EI),
               expected = q * EI / T * (1. - 1. / std::cosh(5. * b));
  const auto found = forces_of(beam("Components = beam; Bending stiffness = 195; Tension = 20000; "
                                    "Element size = 0.05",
                                    "Section areas = 150; Diameters = 14") +
                               "Gravity = 0, -9.81\nTime: Step = 1e-2; End = 0.02\n");
  const double M = value(found, "largest_bending_moment");
  EXPECT_NEAR(M, expected, .03 * expected);
  EXPECT_EQ(value(found, "largest_tension"), T);
  EXPECT_NEAR(value(found, "largest_stress"), T / 150e-6 + M * 32. / (pi * std::pow(.014, 3)), 1.);
}

TEST(SectionForces, of_a_force_that_grows)
{
  // 100 N/s at midspan, slow for a beam of 5 Hz; P L/4 at the end of the run.
  const auto found =
      forces_of(beam("Components = beam; Bending stiffness = 1e6; Mass damping = 20", "") +
                "Gravity = 0, 0\nLoad push: Type = point; On = beam @ 5; Magnitude = 100*t\n"
                "Time: Scheme = Newmark; Step = 1e-2; End = 2\n");
  EXPECT_NEAR(value(found, "largest_bending_moment"), 200. * 10. / 4., 1.);
  EXPECT_NEAR(value(found, "time_of_the_largest_bending_moment"), 2., 1e-9);
  EXPECT_EQ(found.count("largest_stress"), 0u);
}

TEST(SectionForces, of_a_bar)
{
  const auto found = forces_of(
      "Gravity = 0, 0; Start = equilibrium\nWire beam: To = 4, 0; Components = bar; Element size = "
      "0.5; Mass per length = 1; Axial stiffness = 1e6\n"
      "Support wall: Wire = beam; Positions = 0; Motion = axial\n"
      "Load pull: Type = point; On = beam @ 4, 0; Direction = 1, 0; Magnitude = 300\n"
      "Time: Step = 1e-3; End = 1e-3\nOutput: Observers = section forces\n"
      "Output/section forces: Wires = beam\n");
  EXPECT_NEAR(value(found, "largest_tension"), 300., 1e-8);
  EXPECT_EQ(value(found, "largest_bending_moment"), 0.);
}

TEST(SectionForces, of_wires_that_are_not_there_are_refused)
{
  const std::string scene = beam("Components = beam; Bending stiffness = 1e5", "") +
                            "Gravity = 0, 0\nTime: Step = 1e-2; End = 0.02\n";
  const auto error = [&](const std::string &entry)
  {
    return error_of(
        [&]
        {
          Session session(scene, {"Output/section forces/" + entry});
          session.run();
        });
  };
  EXPECT_TRUE(has(error("Wires=bean"), "there is no wire or cable 'bean'; did you mean 'beam'"))
      << error("Wires=bean");
  EXPECT_TRUE(has(error("Wires="), "name the wires")) << error("Wires=");
  EXPECT_TRUE(has(error("Diameters=12"), "both Section areas and Diameters"));
  EXPECT_TRUE(has(error("Diameters=12, 13"), "2 values for 1 wires"));
}

TEST(SectionForces, of_a_cable_that_hangs)
{
  // Straight down with a weight at its end; the upper end carries all.
  const auto found = forces_of(
      "Start = equilibrium\nGravity = 0, -9.81\nBody beam: Type = cable; From = 3, 0; To = 3, -10; "
      "Unstressed length = 10; Held ends = from; Axial stiffness = 1e8; Mass per length = 1.5; "
      "Element = bar\n"
      "Load weight: On = beam @ 10, 0; Direction = 0, -1; Magnitude = 200\n"
      "Time: Step = 1e-2; End = 0.02\nOutput: Observers = section forces\n"
      "Output/section forces: Wires = beam; Section areas = 20; Diameters = 5\n");
  const double T = 200. + 1.5 * 9.81 * 10.;
  EXPECT_NEAR(value(found, "largest_tension"), T, 1e-5 * T);
  EXPECT_NEAR(value(found, "x_of_the_largest_tension"), 3., 1e-9);
  EXPECT_NEAR(value(found, "largest_stress"), T / 20e-6, 10. * T);
  EXPECT_EQ(value(found, "largest_bending_moment"), 0.);
}

TEST(SectionForces, of_a_cable_that_is_clamped)
{
  // A stiff cantilever that hardly bends: force times length at the clamp.
  const auto found = forces_of(
      "Start = equilibrium\nGravity = 0, 0\nBody beam: Type = cable; From = 2, 0; To = 6, 0; "
      "Unstressed length = 4; Held ends = from; Clamped = true; Axial stiffness = 1e7; "
      "Bending stiffness = 1e4; Mass per length = 1\n"
      "Load push: On = beam @ 4, 0; Direction = 0, 1; Magnitude = 5\n"
      "Time: Step = 1e-2; End = 0.02\nOutput: Observers = section forces\n"
      "Output/section forces: Wires = beam\n");
  EXPECT_NEAR(value(found, "largest_bending_moment"), 20., 1e-3 * 20.);
  EXPECT_NEAR(value(found, "x_of_the_largest_bending_moment"), 2., 1e-9);
}
