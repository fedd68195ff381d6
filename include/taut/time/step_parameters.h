// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_parameters_h
#define taut_step_parameters_h

#include <cmath>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Parameters for the length of steps.
  struct StepParameters
  {
    std::string control = "fixed";                 ///< or "adaptive"
    double tolerance = 1e-4;                       ///< bound of LocalError [1]
    unsigned int n_halvings = 10, n_doublings = 4; ///< bounds of the length, from Step
    double largest = 0.;                           ///< longest step; 0: from the doublings [s]

    /// Declares the members in the current subsection.
    void declare_parameters(dealii::ParameterHandler &prm);
    bool adaptive() const { return control == "adaptive"; }

    /// Maximum number of doublings of a Step [s].
    unsigned int most_doublings(double step) const;

    /// Longest step from a Step [s].
    double longest(double step) const
    {
      return adaptive() ? std::ldexp(step, static_cast<int>(most_doublings(step))) : step;
    }
  };
} // namespace taut

#endif
