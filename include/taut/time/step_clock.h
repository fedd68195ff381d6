// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_clock_h
#define taut_step_clock_h

#include <taut/time/integrator.h>

#include <string>

namespace taut
{
  /// Times and coefficients of the steps. Times of equal steps are multiples counted from their
  /// first start, so that they do not drift.
  class StepClock
  {
  public:
    /// The scheme is kept by reference. Steps of length @p step [s] begin at @p start [s]. If the
    /// start is not at rest the first step is backward Euler, unless the scheme needs no initial
    /// acceleration.
    StepClock(const TimeIntegrator &integrator, double step, double start, bool at_rest);

    /// Length of the steps to come [s].
    double step() const { return length; }

    /// Scheme with its parameters, for messages.
    std::string scheme() const { return integrator.description(); }

    /// Coefficients of the next step after a step of length @p last_step [s]; 0: no step before.
    StepCoefficients coefficients(double last_step) const;

    /// Begins a step after one of length @p last_step [s]; returns its end [s].
    double advance(double last_step);

    /// Length of the step before the last one; 0: none [s].
    double step_before() const { return before; }

    /// Changes the length of the steps from @p time on [s].
    void set_step(double length, double time);

    /// Takes back the last step.
    void take_back()
    {
      --n_all;
      --n_in_segment;
    }

    long n_steps() const { return n_all; }

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &length &before &segment_start &n_in_segment &n_all;
    }

  private:
    const TimeIntegrator &integrator;
    double length, before = 0.;
    bool first_is_backward_euler;
    double segment_start; ///< start of the first step of this length
    long n_in_segment = 0, n_all = 0;
  };
} // namespace taut

#endif
