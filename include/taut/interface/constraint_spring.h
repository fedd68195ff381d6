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
  /// What is between the bodies and the multiplier of a constraint: nothing, a linear spring with a
  /// damper, or one that follows a law. Forces are in N, or N m; compressions in m, or rad.
  struct ConstraintSpring
  {
    double stiffness = std::numeric_limits<double>::infinity(); ///< [N/m, N m/rad]
    double damping = 0.;                                        ///< [N s/m, N m s/rad]

    /// The force over the compression, of unilateral constraints; null: linear. The stiffness is
    /// then its largest one.
    std::shared_ptr<const ForceLaw> law = {};

    /// True if a mean force over a step works as much as the spring stores, closing and opening
    /// included; see ContactResolution.
    bool conserving = false;

    bool is_rigid() const { return std::isinf(stiffness); }

    /// S of the spring with its damper, whose velocity changes by @p rate [1/s] times its
    /// compression; 0 of a rigid one [m/N, rad/(N m)].
    double compliance(const double rate = 0.) const { return 1. / (stiffness + rate * damping); }

    /// The force under a compression at rest, and the compression under a force; 0 of a rigid one.
    double force(double compression) const;
    double compression(double force) const;

    /// The stored energy; 0 of a rigid spring [J].
    double energy(double compression) const;

    /// What is wrong with its numbers, for a message; empty: nothing.
    std::string fault() const;
  };
} // namespace taut

#endif
