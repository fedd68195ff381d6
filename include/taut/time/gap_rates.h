// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_gap_rates_h
#define taut_gap_rates_h

#include <taut/interface/constraints.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * Rates D' of the gaps in schemes with mean forces [m/s, rad/s]. For a moving constraint, the
   * motion of its place adds to B^T V. With a velocity projection this is v (dB/dx)^T U + r' at the
   * end of the step, otherwise the mean ((B - B_0)^T U_0 + D0 - D0_0) / step over the step. All
   * functions with a state are called by all ranks together.
   */
  class GapRates
  {
  public:
    /// The arguments are kept by reference.
    GapRates(const Structure &structure, const Constraints &constraints,
             const Reference &reference);

    /// Sets the coefficients and the length [s] of the steps to come.
    void prepare(const StepCoefficients &c, double step);

    /// Begins a step with B^T V of the state before it.
    void begin(const State &before);

    /// Sets the change of a gap in the step by the motion of its place [m].
    void set_convection(const std::size_t i, const double way) { convection[i] = way; }
    double of_convection(const std::size_t i) const { return convection[i]; }

    /// After the step with the end @p state: sets its rates and those before the step.
    void accept(State &state);

    /// After a velocity projection, which changes velocities of @p state: sets its rates again.
    void update(State &state);

    /// B^T V after the last begin(), accept() or update(), the sum of the sizes of its terms, and
    /// D' at the start of the step.
    const std::vector<double> &velocities() const { return velocity; }
    const std::vector<double> &velocity_sizes() const { return velocity_size; }
    const std::vector<double> &before_step() const { return rates_before; }

  private:
    void measure(const State &state);
    void measure_convection(const State &state);

    const Structure &structure;
    const Constraints &constraints;
    const Reference &reference;
    bool is_projected = false;
    double step = 0.;
    std::vector<double> velocity, velocity_size, convection, rates_before;
    std::vector<double> rate_of_place; ///< D' minus B^T V, with a velocity projection
  };
} // namespace taut

#endif
