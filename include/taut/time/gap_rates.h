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
   * Rates D' of the gaps through the steps of schemes with mean forces [m/s, rad/s]. The rate of a
   * moving constraint has what the motion of its place adds to B^T V: with a velocity projection at
   * the end of the step, v (dB/dx)^T U + r', otherwise as a mean over the step,
   * ((B - B_0)^T U_0 + D0 - D0_0) / step. All functions that take a state are called by all ranks
   * together.
   */
  class GapRates
  {
  public:
    /// The arguments are kept by reference.
    GapRates(const Structure &structure, const Constraints &constraints,
             const Reference &reference);

    /// For steps with these coefficients from now on [s].
    void prepare(const StepCoefficients &c, double step);

    /// Begins a step: B^T V of the state before it.
    void begin(const State &before);

    /// What the motion of its place adds to a gap in the step [m].
    void set_convection(const std::size_t i, const double way) { convection[i] = way; }
    double of_convection(const std::size_t i) const { return convection[i]; }

    /// After the step, whose end @p state has: the rates of the state, and those before.
    void accept(State &state);

    /// After a change of the velocities of @p state, with a velocity projection: its rates anew.
    void update(State &state);

    /// B^T V of begin(), accept() or update(), whichever was last, and the sums of the sizes of its
    /// terms; D' at the start of the step.
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
    std::vector<double> rate_of_place; ///< D' besides B^T V, with a velocity projection
  };
} // namespace taut

#endif
