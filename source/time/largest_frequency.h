// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_largest_frequency_h
#define taut_largest_frequency_h

#include <taut/interface/constraints.h>
#include <taut/time/step_parameters.h>

namespace taut
{
  /**
   * The largest natural frequency of the bodies with their elastic constraints closed in their
   * present places [rad/s]. Rigid constraints, which can only lower it, are left out; massless DoFs
   * are held. Power iteration gives a lower bound, short by a few hundredths at most. 0 without
   * bodies that have mass and stiffness. Called by all ranks together.
   */
  double largest_frequency(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters);
} // namespace taut

#endif
