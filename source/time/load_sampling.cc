// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/load_sampling.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Samples in a reference step, and bounds of the samples in a step; even numbers.
    constexpr int samples_of_reference = 16, fewest_samples = 4, most_samples = 1 << 16;
  } // namespace

  LoadSampling::LoadSampling(const Structure &structure) : structure(structure)
  {
    bool has_motion = false;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      if (structure[k].external_force_varies())
        varying.push_back(k);
      has_motion = has_motion || structure[k].has_moving_constraints();
    }
    largest_loads.assign(varying.size(), 0.);
    largest_motions.assign(structure.size(), 0.);
    is_constant = !structure.communicator().any(has_motion || !varying.empty());
  }

  /// Difference of both integrals, over the largest value so far and the reference step.
  template <typename Sample>
  double LoadSampling::mismatch(const double t, const double length, const double reference_step,
                                const Sample &sample, double &largest)
  {
    const double wanted = samples_of_reference * length / reference_step;
    const int half = static_cast<int>(
                  std::ceil(.5 * std::clamp<double>(wanted, fewest_samples, most_samples))),
              n = 2 * half;
    const double between = length / n;
    for (int j = 0; j <= n; ++j)
    {
      sample(t + j * between, values);
      if (j == 0)
      {
        sums.trapezoids.assign(values.size(), 0.);
        sums.simpson.assign(values.size(), 0.);
      }
      const double weight = j == 0 || j == n ? .5 : 1., of_simpson = j == 0 || j == n ? 1. / 6.
                                                                     : j == half      ? 4. / 6.
                                                                                      : 0.;
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        sums.trapezoids[i] += weight * between * values[i];
        sums.simpson[i] += of_simpson * length * values[i];
        largest = std::max(largest, std::fabs(values[i]));
      }
    }
    double difference = 0.;
    for (std::size_t i = 0; i < sums.simpson.size(); ++i)
      difference = std::max(difference, std::fabs(sums.trapezoids[i] - sums.simpson[i]));
    return difference == 0. ? 0. : difference / (largest * reference_step);
  }

  bool LoadSampling::is_resolved(const double t, const double length, const double reference_step,
                                 const double tolerance)
  {
    if (is_constant)
      return true;
    double worst = 0.;
    structure.communicator().agree(
        [&]
        {
          for (std::size_t v = 0; v < varying.size(); ++v)
            worst = std::max(worst, mismatch(
                                        t, length, reference_step,
                                        [&](const double at, std::vector<double> &P)
                                        { structure[varying[v]].external_force(at, P); },
                                        largest_loads[v]));
          for (std::size_t k = 0; k < structure.size(); ++k)
            if (structure[k].has_moving_constraints())
              worst =
                  std::max(worst, mismatch(
                                      t, length, reference_step,
                                      [&](const double at, std::vector<double> &u)
                                      {
                                        u.clear();
                                        for (const ConstrainedDof &dof : structure[k].constraints())
                                          u.push_back(dof.at(at));
                                      },
                                      largest_motions[k]));
        });
    return structure.communicator().max(worst) <= tolerance;
  }
} // namespace taut
