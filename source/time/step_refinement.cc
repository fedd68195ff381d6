// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/time_stepper.h>

namespace taut
{
  /**
   * Iterative refinement of an accepted step. A step whose increment is large against the
   * displacement that it ends with loses digits by cancellation; what the balance at its end lacks
   * is solved for. False, and nothing changes, if the constraints have no answer to it.
   */
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
