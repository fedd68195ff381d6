// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraint_spring_h
#define taut_constraint_spring_h

#include <taut/base/force_law.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

namespace taut
{
  /// The spring between the bodies and the multiplier of a constraint: rigid, linear with a damper,
  /// or with a law. Forces are in N, or N m; compressions in m, or rad.
  struct ConstraintSpring
  {
    double stiffness = std::numeric_limits<double>::infinity(); ///< [N/m, N m/rad]
    double damping = 0.;                                        ///< [N s/m, N m s/rad]

    /// Force as a function of compression, for unilateral constraints; null: linear. The stiffness
    /// then is the largest stiffness of the law.
    std::shared_ptr<const ForceLaw> law = {};

    /// True if the work of a mean force over a step is the change of the spring's energy, also in
    /// closing and opening; see ContactResolution.
    bool conserving = false;

    bool is_rigid() const { return std::isinf(stiffness); }

    /// S of the spring with its damper, whose velocity changes by @p rate [1/s] times its
    /// compression; 0 for a rigid spring [m/N, rad/(N m)].
    double compliance(const double rate = 0.) const { return 1. / (stiffness + rate * damping); }

    /// Force at rest under a compression, and compression under a force; 0 for a rigid spring.
    double force(double compression) const;
    double compression(double force) const;

    /// Stored energy; 0 for a rigid spring [J].
    double energy(double compression) const;

    /// Error in the numbers, for a message; empty: none.
    std::string fault() const;
  };
} // namespace taut

#endif
