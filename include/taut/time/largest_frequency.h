// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_largest_frequency_h
#define taut_largest_frequency_h

#include <taut/interface/constraints.h>
#include <taut/time/solver_parameters.h>

namespace taut
{
  /**
   * The largest natural frequency of the bodies with their elastic constraints closed, where these
   * are, and without the rigid ones, which can only lower it [rad/s]. DoFs without mass are held.
   * From below, by power iteration: short of it by a few hundredths at most. Called by all ranks
   * together; 0 without bodies that have mass and stiffness.
   */
  double largest_frequency(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters);
} // namespace taut

#endif
