// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a sliding contact feels the height profile of its wire and the wire itself where it is.
// Sources: on a wire that hardly yields, a mass on a contact spring is an oscillator shaken by the
// profile, m x" + (k + k_0) x = k r(v t), solved here in closed form; a contact pressed by a
// constant force without mass raises a string as a moving force does.
#include "scene_tests.h"

using namespace verification;

// 5 kg, spring of 2 kN/m to the ground, contact spring of 10 kN/m, pressed by 60 N, at 4 m/s over
// waves of 1 mm and 2 m. With Omega^2 = (k + k_0)/m, omega = 2 pi 4/2 1/s and r = a (1 - cos omega
// t): x = k a/m [(1 - cos Omega t)/Omega^2 - (cos omega t - cos Omega t)/(Omega^2 - omega^2)].
TEST(SlidingContact, wavy_wire_shakes_an_oscillator)
{
  const std::string scene =
      R"(Gravity = 0, 0; Start = equilibrium
Wire wire: To = 10, 0; Components = string; Mass per length = 1; Tension = 1e9; Element size = 0.5
Support ends: Wire = wire; Positions = 0, 10
Mass mass: Position = 1, 0; Mass = 5; Motions = y
Spring spring: From = ground; To = mass; Stiffness = 2000
Link contact: Type = sliding contact; From = mass; To = wire @ 1; Direction = 0, 1;
  Stiffness = 10000; Speed = 4; Height profile = 1e-3*(1-cos(pi*(s-1)))
Load force: Type = point; On = mass; Magnitude = 60
Time: Scheme = generalised-alpha; Step = 1e-4; End = 2
)";
  const double m = 5., k0 = 2000., k = 1e4, a = 1e-3, omega = 4. * std::acos(-1.),
               Omega = std::sqrt((k + k0) / m), at_rest = 60. / (k + k0);
  double error = 0., force_error = 0., largest = 0., least_force = 1e9;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time;
              const double x =
                  k * a / m *
                  ((1. - std::cos(Omega * t)) / (Omega * Omega) -
                   (std::cos(omega * t) - std::cos(Omega * t)) / (Omega * Omega - omega * omega));
              const double r = a * (1. - std::cos(omega * t));
              const double N = k * (at_rest + x - r),
                           u = view.reference.displacement[1][0] + view.state.U[1][0];
              raise(error, u - at_rest - x);
              raise(force_error, view.state.multiplier[0] - N);
              raise(largest, x);
              least_force = std::min(least_force, view.state.multiplier[0]);
            });
  figure("oscillator shaken by a wavy wire, error of the motion over its largest", error / largest);
  figure("oscillator shaken by a wavy wire, error of the force over 50 N", force_error / 50.);
  EXPECT_GT(least_force, 10.) << "the contact must not open";
  EXPECT_LT(error, 1e-3 * largest);
  EXPECT_LT(force_error, .05);
}

// T = 20 kN, 1.35 kg/m, 250 km/h, 120 N: F v t/(T (1 + v/c)) under the contact, whatever its spring
// is. The contact starts on the support.
TEST(SlidingContact, constant_force_on_a_mass_redistribution_is_a_moving_force)
{
  const double v = 250. / 3.6;
  const std::string scene = R"(Gravity = 0, 0; Start = equilibrium
Wire string: To = 60, 0; Components = string; Mass per length = 1.35; Tension = 20000;
  Element size = 0.05; Degree = 2
Support ends: Wire = string; Positions = 0, 60
Mass mass: Mass = 0.001; Motions = y
Link contact: Type = sliding contact; From = mass; To = string @ 0; Direction = 0, 1;
  Stiffness = 50000; Damping = 20; Speed = )" +
                            number(v) + R"(
Load force: Type = point; On = mass; Magnitude = 120
Time: Scheme = BDF2; Step = 5e-4; End = 0.4
)";
  const double c = std::sqrt(20000. / 1.35);
  double error = 0., force_error = 0., compression = 0.;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time;
              if (t < .1)
                return;
              const double exact = 120. * v * t / (20000. * (1. + v / c)),
                           w = displacement(view, 0, v * t);
              error = std::max(error, std::fabs(w - exact) / exact);
              raise(force_error, view.state.multiplier[0] - 120.);
              compression = -view.state.distance[0];
            });
  const std::string name = "sliding contact as a moving force, ";
  EXPECT_LT(figure(name + "largest relative error under it, 0.1..0.4 s", error), 2e-3);
  EXPECT_LT(figure(name + "largest error of the force", force_error, "N"), 1.);
  EXPECT_NEAR(figure(name + "compression of the contact spring at 0.4 s", 1e3 * compression, "mm"),
              2.4, .24);
}
