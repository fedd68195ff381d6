// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_static_equilibrium_h
#define taut_static_equilibrium_h

#include <taut/interface/constraints.h>
#include <taut/time/residuals.h>
#include <taut/time/step_parameters.h>

#include <vector>

namespace taut
{
  /// Displacements, contact forces and gaps at rest.
  struct StaticState
  {
    BodyVectors displacement;                ///< U [m, rad]
    std::vector<double> multiplier;          ///< N [N, N m]
    std::vector<double> complementarity_gap; ///< D [m, rad]
    std::vector<double> distance;            ///< D - S N [m, rad]
    Residuals residuals;
    std::vector<std::size_t> repeated_joints = {}; ///< numbers, see RepeatedRows
  };

  /**
   * Solves K U = P(t) + B N, or f(U) = P(t) + B N of bodies that are not linear, with the links'
   * complementarity, without inertia; t in s. Bodies that only links hold keep the amplitudes of
   * their rigid body modes as unknowns. Called by all ranks together. Throws BodyNotHeld,
   * ContradictoryRows, or UserError if the residuals misses the contact tolerance.
   */
  StaticState static_equilibrium(const Structure &structure, const Constraints &constraints,
                                 const SolverParameters &parameters, double t);
} // namespace taut

#endif
