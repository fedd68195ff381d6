// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_wavy_floor_h
#define taut_wavy_floor_h

#include <cmath>
#include <string>

/// An elastic slab of 20 m x 1 m in plane strain, whose top is pressed down onto a floor of eight
/// waves, more on the right than on the left, and up and down by turns. The sides do not move along
/// x.
namespace wavy_floor
{
  constexpr double length = 20., E = 1e9, nu = .3, density = 2000.; // m, Pa, 1, kg/m^3

  /// Vertical displacement of the top at x and t [m].
  inline double top(const double x, const double t)
  {
    return -.0012 - .00003 * x - .0006 * std::cos(20. * M_PI * t);
  }

  /// Height of the floor at x [m], and its derivative.
  inline double floor(const double x)
  {
    return .002 * (std::cos(.8 * M_PI * x) - 1.);
  }
  inline double slope(const double x)
  {
    return -.0016 * M_PI * std::sin(.8 * M_PI * x);
  }

  /// The scene with @p n_x squares along x, from the equilibrium at t = 0 on, with @p n_steps of
  /// backward Euler [s].
  inline std::string scene(const unsigned int n_x, const int n_steps = 0, const double step = 2e-4)
  {
    return "set Generator = network\n"
           "set Gravity   = 0, 0\n"
           "set Start     = equilibrium\n"
           "set Bodies    = slab\n"
           "set Contacts  = floor\n"
           "subsection Body slab\n"
           "  set Type = solid\n"
           "  set Young's modulus = 1e9\n"
           "  set Poisson's ratio = 0.3\n"
           "  set Density = 2000\n"
           "  set Symmetry boundaries = 0, 1\n"
           "  set Displacement = 3: 0, -0.0012 - 0.00003*x - 0.0006*cos(20*pi*t)\n"
           "  subsection Mesh\n"
           "    set Generator = subdivided_hyper_rectangle\n"
           "    set Arguments = " +
           std::to_string(n_x) + ", " + std::to_string(n_x / 20) +
           " : 0, 0 : 20, 1\n"
           "  end\n"
           "end\n"
           "subsection Contact floor\n"
           "  set Slave = slab: 2\n"
           "  set Obstacle = height\n"
           "  set Direction = 0, 1\n"
           "  set Height = 0.002*(cos(0.8*pi*x) - 1)\n"
           "  set Search distance = 1\n"
           "end\n"
           "subsection Time\n"
           "  set Scheme = backward Euler\n"
           "  set Step = " +
           std::to_string(step) + "\n  set End = " + std::to_string(step * n_steps) +
           "\nend\n"
           "subsection Output\n"
           "  set Field interval = 0\n"
           "end\n";
  }
} // namespace wavy_floor

#endif
