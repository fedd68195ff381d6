// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_wavy_floor_h
#define taut_wavy_floor_h

#include <cmath>
#include <string>

/// An elastic slab of 20 m x 1 m in plane strain, whose top is pressed down onto a floor of eight
/// waves, more on the right, and up and down by turns. The sides do not move along x.
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

  /// The scene with @p n_x squares along x, from equilibrium on, with steps of backward Euler [s].
  inline std::string scene(const unsigned int n_x, const int n_steps = 0, const double step = 2e-4)
  {
    return R"(Generator = network; Gravity = 0, 0; Start = equilibrium
Body slab: Type = solid; Young's modulus = 1e9; Poisson's ratio = 0.3; Density = 2000;
  Symmetry boundaries = 0, 1; Displacement = 3: 0, -0.0012 - 0.00003*x - 0.0006*cos(20*pi*t)
Body slab/Mesh: Generator = subdivided_hyper_rectangle;
  Arguments = )" +
           std::to_string(n_x) + ", " + std::to_string(n_x / 20) + R"( : 0, 0 : 20, 1
Contact floor: Slave = slab: 2; Obstacle = height; Direction = 0, 1;
  Height = 0.002*(cos(0.8*pi*x) - 1); Search distance = 1
Time: Scheme = backward Euler; Step = )" +
           std::to_string(step) + "; End = " + std::to_string(step * n_steps) +
           "\nOutput: Field interval = 0\n";
  }
} // namespace wavy_floor

#endif
