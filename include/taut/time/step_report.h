// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_report_h
#define taut_step_report_h

#include <taut/time/step_method.h>

#include <numeric>
#include <vector>

namespace taut
{
  /// What a step says to those who watch it, beside the motion and its residuals. Before the first
  /// step, lists are empty.
  struct StepReport
  {
    StepMethod method; ///< whether multipliers are means over the step, among others

    /// Work of the mean force of each row on the bodies, without the force of a sliding row in its
    /// old place [J]; 0 for a force at the end of the step.
    std::vector<double> work;

    /// Work of the impulses of a velocity projection, a part of that work [J].
    double impulse_work = 0.;

    /// Energy that each group of connected bodies gained beyond the work of loads and moving rows;
    /// empty: not known [J].
    std::vector<double> gains;

    /// Whether the multiplier of a row is a mean over the step.
    bool is_mean(const std::size_t i) const
    {
      return !method.rules.empty() && method.rules[i].is_mean();
    }

    /// Of all groups; 0 if it is not known [J].
    double gain() const { return std::accumulate(gains.begin(), gains.end(), 0.); }

    /// For Boost's archives.
    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &method &work &impulse_work &gains;
    }
  };
} // namespace taut

#endif
