// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_impulse_of_step_h
#define taut_impulse_of_step_h

#include <taut/interface/constraints.h>
#include <taut/time/step_report.h>

namespace taut
{
  /**
   * Impulse of constraint @p i over a step of length @p dt [s], from its multipliers before and
   * after it: the trapezoidal rule, unless the multiplier is a mean over the step. So are those of
   * rigid unilateral constraints in any scheme, as an impact is a single one [N s, N m s].
   */
  inline double impulse_of_step(const Constraints &constraints, const StepReport &report,
                                const std::size_t i, const double before, const double after,
                                const double dt)
  {
    const bool is_impact = constraints[i].spring.is_rigid() && constraints[i].cone.may_open();
    return (report.is_mean(i) || is_impact ? after : .5 * (before + after)) * dt;
  }
} // namespace taut

#endif
