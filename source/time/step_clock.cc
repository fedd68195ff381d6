// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/step_clock.h>

namespace taut
{
  StepClock::StepClock(const TimeIntegrator &integrator, const double step, const double start,
                       const bool at_rest)
      : integrator(integrator), length(step),
        first_is_backward_euler(!at_rest && !integrator.coefficients(step).starts_itself()),
        segment_start(start)
  {
  }

  StepCoefficients StepClock::coefficients(const double last_step) const
  {
    if (last_step == 0. && first_is_backward_euler)
      return backward_euler(length);
    return last_step == 0. || last_step == length ? integrator.coefficients(length)
                                                  : integrator.after_change(length, last_step);
  }

  double StepClock::advance(const double last_step)
  {
    ++n_all;
    before = last_step;
    return segment_start + ++n_in_segment * length;
  }

  void StepClock::set_step(const double new_length, const double time)
  {
    if (new_length == length)
      return;
    length = new_length;
    segment_start = time;
    n_in_segment = 0;
  }
} // namespace taut
