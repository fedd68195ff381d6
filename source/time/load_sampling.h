// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_load_sampling_h
#define taut_load_sampling_h

#include <taut/substructure/structure.h>

#include <vector>

namespace taut
{
  /**
   * Looks inside a step for jumps and short pulses of loads and prescribed motions, which values at
   * the ends of the step miss. Use it before an adaptive step.
   *
   * There are sixteen samples in a reference step, and at least four in a step. Their integral by
   * the trapezoidal rule is compared with that by Simpson's rule from the ends and the middle. For
   * smooth values both agree to fourth order.
   */
  class LoadSampling
  {
  public:
    /// @p structure is kept by reference.
    explicit LoadSampling(const Structure &structure);

    /// True if both integrals over @p length [s] from @p t [s] agree within @p tolerance times the
    /// largest value so far times @p reference_step [s]. Called by all ranks together.
    bool is_resolved(double t, double length, double reference_step, double tolerance);

  private:
    /// Integrals of the values of one body or prescribed motion.
    struct Sums
    {
      std::vector<double> trapezoids, simpson;
      double size = 0.; ///< largest value
    };
    template <typename Sample>
    double mismatch(double t, double length, double reference_step, const Sample &sample,
                    double &largest);

    const Structure &structure;
    std::vector<std::size_t> varying;  ///< bodies with varying loads
    std::vector<double> largest_loads; ///< largest load of each body so far [N]
    std::vector<double> largest_motions;
    bool is_constant = true; ///< on all ranks
    std::vector<double> values;
    Sums sums;
  };
} // namespace taut

#endif
