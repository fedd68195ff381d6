// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_load_sampling_h
#define taut_load_sampling_h

#include "time/excitations.h"

#include <vector>

namespace taut
{
  /**
   * Looks inside a step for jumps and short pulses of excitations, which values at the ends of the
   * step miss. Use it before an adaptive step.
   *
   * There are sixteen samples in a reference step, or four in the narrowest feature that such steps
   * do not see, and at least four in a step. Their integral by the trapezoidal rule is compared
   * with that by Simpson's rule from the ends and the middle. For smooth values both agree to
   * fourth order.
   */
  class LoadSampling
  {
  public:
    /// For steps about @p reference_step [s]; samples are at most @p between apart [s].
    LoadSampling(std::vector<Excitation> all, const Communicator &processes, double reference_step,
                 double between);

    /// True if both integrals over @p length [s] from @p t [s] agree within @p tolerance times the
    /// largest value so far times the reference step. Called by all ranks together.
    bool is_resolved(double t, double length, double tolerance);

  private:
    double mismatch(double t, double length, std::size_t i);

    const std::vector<Excitation> all;
    const Communicator &processes;
    const double reference_step, between; ///< steps and samples [s]
    const bool is_constant;               ///< on all ranks
    std::vector<double> largest;          ///< value of each excitation so far
  };
} // namespace taut

#endif
