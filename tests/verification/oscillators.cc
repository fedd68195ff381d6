// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: springs, dampers and joints between masses, and joints on a support that moves, are those
// of textbooks. Sources: two masses with a spring and a damper between them and no force from
// outside keep their momentum, and their distance is a damped oscillator of the reduced mass; a
// mass on a spring whose other end moves by a (1 - cos omega t) moves by a [1 - (Omega^2 cos omega
// t - omega^2 cos Omega t)/(Omega^2 - omega^2)].
#include "run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace verification;

TEST(Oscillator, two_masses_on_one_spring_and_damper)
{
  const double m1 = 2., m2 = 3., k = 120., c = 3., V = .4, v = -.1;
  const char *const scene =
      "set Generator = network\nset Gravity = 0, 0\nset Start = given\n"
      "subsection Network\n set Masses = one, two\n set Springs = spring\n"
      " subsection Mass one\n  set Position = 0, 0\n  set Mass = 2\n  set Motions = y\n"
      "  set Initial velocity = 0, 0.4, 0\n end\n"
      " subsection Mass two\n  set Position = 0, 1\n  set Mass = 3\n  set Motions = y\n"
      "  set Initial velocity = 0, -0.1, 0\n end\n"
      " subsection Spring spring\n  set From = one\n  set To = two\n  set Direction = 0, 1\n"
      "  set Stiffness = 120\n  set Damping = 3\n end\nend\n"
      "subsection Time\n set Scheme = Newmark\n set Step = 2e-4\n set End = 2\nend\n";
  const double mu = m1 * m2 / (m1 + m2), decay = .5 * c / mu,
               omega = std::sqrt(k / mu - decay * decay);
  double error = 0., size = 0.;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time;
              const double distance = (v - V) / omega * std::exp(-decay * t) * std::sin(omega * t),
                           middle = (m1 * V + m2 * v) / (m1 + m2) * t;
              const std::vector<double> &u = view.state.U[0];
              error = std::max({error, std::fabs(u[0] - (middle - m2 / (m1 + m2) * distance)),
                                std::fabs(u[1] - (middle + m1 / (m1 + m2) * distance))});
              size = std::max(size, std::fabs(distance));
            });
  figure("two masses on a spring and damper, largest error over the largest elongation",
         error / size);
  EXPECT_LT(error, 1e-4 * size);
}

TEST(Oscillator, mass_on_a_support_that_moves)
{
  const double m = 2., k = 800., a = .01, omega = 8., Omega = std::sqrt(k / m);
  const char *const scene =
      "set Generator = network\nset Gravity = 0, 0\nset Start = equilibrium\n"
      "subsection Network\n set Wires = wire\n set Supports = moving, end\n set Masses = mass\n"
      " set Links = joint\n"
      " subsection Wire wire\n  set To = 4, 0\n  set Components = string\n"
      "  set Mass per length = 1\n  set Tension = 1000\n  set Element size = 0.5\n end\n"
      " subsection Support moving\n  set Wire = wire\n  set Positions = 0\n"
      "  set Displacement = 0.01*(1-cos(8*t))\n end\n"
      " subsection Support end\n  set Wire = wire\n  set Positions = 4\n end\n"
      " subsection Mass mass\n  set Position = 0, -1\n  set Mass = 2\n  set Motions = y\n end\n"
      " subsection Link joint\n  set Type = joint\n  set From = mass\n  set To = wire @ 0\n"
      "  set Direction = 0, 1\n  set Stiffness = 800\n end\nend\n"
      "subsection Time\n set Scheme = Newmark\n set Step = 2e-4\n set End = 2\nend\n";
  double error = 0., force_error = 0., gap_error = 0.;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time;
              const double support = a * (1. - std::cos(omega * t)),
                           u = a * (1. - (Omega * Omega * std::cos(omega * t) -
                                          omega * omega * std::cos(Omega * t)) /
                                             (Omega * Omega - omega * omega));
              error = std::max(error, std::fabs(view.state.U[1][0] - u));
              force_error =
                  std::max(force_error, std::fabs(view.state.multiplier[0] - k * (u - support)));
              gap_error = std::max(gap_error, std::fabs(view.state.geometric_gap[0] -
                                                        (support - view.state.U[1][0])));
            });
  figure("mass on a support that moves, largest error over the way of the support", error / a);
  figure("mass on a support that moves, largest error of the force", force_error, "N");
  EXPECT_LT(error, 1e-4 * a);
  EXPECT_LT(force_error, 1e-4 * k * a);
  EXPECT_LT(gap_error, 1e-14);
}

// The spring carries m g below a support that has sunk by 2 cm; its end is a held unknown.
TEST(Oscillator, mass_hangs_at_rest_below_a_sunken_support)
{
  const char *const scene =
      "set Generator = network\nset Gravity = 0, -9.81\nset Start = equilibrium\n"
      "subsection Network\n set Wires = wire\n set Supports = sunken, end\n set Masses = mass\n"
      " set Links = joint\n"
      " subsection Wire wire\n  set To = 4, 0\n  set Components = string\n"
      "  set Mass per length = 1\n  set Tension = 1000\n  set Element size = 0.5\n end\n"
      " subsection Support sunken\n  set Wire = wire\n  set Positions = 0\n"
      "  set Displacement = -0.02\n end\n"
      " subsection Support end\n  set Wire = wire\n  set Positions = 4\n end\n"
      " subsection Mass mass\n  set Position = 0, -1\n  set Mass = 2\n  set Motions = y\n end\n"
      " subsection Link joint\n  set Type = joint\n  set From = mass\n  set To = wire @ 0\n"
      "  set Direction = 0, 1\n  set Stiffness = 800\n end\nend\n"
      "subsection Time\n set Step = 1e-3\n set End = 1e-3\nend\n";
  const double weight = 2. * 9.81;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              EXPECT_NEAR(view.reference.displacement[1][0] + view.state.U[1][0],
                          -.02 - weight / 800., 1e-14);
              EXPECT_NEAR(view.state.multiplier[0], -weight, 1e-10);
            });
}

// Claim: a step that brings a body back from afar does not end with the rounding of its way.
// Expected: one step of backward Euler of two joined masses, each on
// a spring, ((m1 + m2)/step^2 + k1 + k2) u = P + (m1 + m2) u0/step^2.
TEST(Oscillator, a_step_from_afar_ends_as_accurately_as_any)
{
  const double m1 = 1., m2 = 3., k1 = 1000., k2 = 3000., P = 1e-9, u0 = 10., step = 1e6;
  const char *const scene =
      "set Generator = network\nset Gravity = 0, 0\nset Start = given\n"
      "subsection Network\n set Masses = one, two\n set Springs = first, second\n set Loads = "
      "push\n"
      " set Links = joint\n"
      " subsection Mass one\n  set Position = 0, 0\n  set Mass = 1\n  set Motions = y\n"
      "  set Initial displacement = 0, 10, 0\n end\n"
      " subsection Mass two\n  set Position = 0, 1\n  set Mass = 3\n  set Motions = y\n"
      "  set Initial displacement = 0, 10, 0\n end\n"
      " subsection Spring first\n  set From = ground\n  set To = one\n  set Direction = 0, 1\n"
      "  set Stiffness = 1000\n end\n"
      " subsection Spring second\n  set From = ground\n  set To = two\n  set Direction = 0, 1\n"
      "  set Stiffness = 3000\n end\n"
      " subsection Load push\n  set On = one\n  set Direction = 0, 1\n  set Magnitude = 1e-9\n "
      "end\n"
      " subsection Link joint\n  set Type = joint\n  set From = one\n  set To = two\n"
      "  set Direction = 0, 1\n  set Stiffness = rigid\n end\nend\n"
      "subsection Time\n set Scheme = backward Euler\n set Step = 1e6\n set End = 1e6\nend\n";
  const double m = (m1 + m2) / (step * step), u = (P + m * u0) / (m + k1 + k2);
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              if (view.state.time == 0.)
                return;
              EXPECT_NEAR(view.state.U[0][0], u, 1e-9 * u);
              EXPECT_NEAR(view.state.U[1][0], u, 1e-9 * u);
              const double N = k2 * u + m2 / (step * step) * (u - u0);
              EXPECT_NEAR(std::fabs(view.state.multiplier[0]), N, 1e-9 * N);
              EXPECT_NEAR(view.state.geometric_gap[0], 0., 1e-9 * u);
            });
}
