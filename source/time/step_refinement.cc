// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/time_stepper.h>

namespace taut
{
  /// Iterative refinement of an accepted step: solves for the residual of the balance at its end. A
  /// large increment against the final displacement loses digits by cancellation. False, without
  /// changes, if the constraints have no solution.
  bool TimeStepper::refine()
  {
    history.set_lacking(coefficients, *system, current);
    if (!conditions.correct(current, *system, history.loads()))
      return false;
    system->find_increments(conditions.corrections().multiplier,
                            conditions.corrections().mode_amplitude, history.increments());
    history.add_correction(coefficients, current);
    conditions.add_correction(history.increments(), current);
    return true;
  }
} // namespace taut
