// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_start_h
#define taut_start_h

namespace taut
{
  /// How a run starts.
  enum class Start
  {
    equilibrium, ///< static equilibrium under the loads at t = 0, at rest
    undeformed,  ///< all displacements zero, at rest
    given        ///< the initial displacements and velocities of the bodies
  };
} // namespace taut

#endif
