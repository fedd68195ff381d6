// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/load_sampling.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  namespace
  {
    /// Samples in a reference step, and bounds of the samples in a step; even numbers. With two
    /// samples both rules would know the same three values only.
    constexpr int samples_of_reference = 16, fewest_samples = 4, most_samples = 1 << 16;
  } // namespace

  LoadSampling::LoadSampling(std::vector<Excitation> excitations, const Communicator &processes,
                             const double reference_step, const double most_between)
      : all(std::move(excitations)), processes(processes), reference_step(reference_step),
        between(std::min(reference_step / samples_of_reference, most_between)),
        is_constant(!processes.any(!all.empty())), largest(all.size(), 0.)
  {
  }

  /// Difference of both integrals, over the largest value so far and the reference step.
  double LoadSampling::mismatch(const double t, const double length, const std::size_t i)
  {
    const int half = static_cast<int>(std::ceil(
                  .5 * std::clamp<double>(length / between, fewest_samples, most_samples))),
              n = 2 * half;
    double trapezoids = 0., simpson = 0.;
    for (int j = 0; j <= n; ++j)
    {
      const double value = all[i].at(t + j * length / n);
      trapezoids += (j == 0 || j == n ? .5 : 1.) * value / n;
      simpson += (j == 0 || j == n ? 1. / 6. : j == half ? 4. / 6. : 0.) * value;
      largest[i] = std::max(largest[i], std::fabs(value));
    }
    const double difference = length * std::fabs(trapezoids - simpson);
    return difference == 0. ? 0. : difference / (largest[i] * reference_step);
  }

  bool LoadSampling::is_resolved(const double t, const double length, const double tolerance)
  {
    if (is_constant)
      return true;
    double worst = 0.;
    processes.agree(
        [&]
        {
          for (std::size_t i = 0; i < all.size(); ++i)
            worst = std::max(worst, mismatch(t, length, i));
        });
    return processes.max(worst) <= tolerance;
  }
} // namespace taut
