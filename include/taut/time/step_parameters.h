// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_step_parameters_h
#define taut_step_parameters_h

#include <taut/interface/interface_parameters.h>

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

    /// Steps in contacts with dampers, over those that keep the rebound within a percent [1].
    double in_damped_contacts = 1.;

    /// Declares the members in the current subsection.
    void declare_parameters(dealii::ParameterHandler &prm);

    /// The shortest step about a given one [s].
    double shortest(const double step) const
    {
      return adaptive() ? std::ldexp(step, -static_cast<int>(n_halvings)) : step;
    }

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

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Names and numbers of the solvers in a step.
  struct SolverParameters
  {
    SolverParameters(); // not inline: GCC 12 warns of the members of an inline one

    std::string local_solver = "block tridiagonal"; ///< see make_local_solver()
    InterfaceParameters interface;
    std::string complementarity = "semismooth Newton"; ///< or "energy-ordered", "MPRGP"
    double contact_tolerance = 1e-8;                   ///< bound of Residuals::max() [1]

    /// Declares the members in subsection "Solver".
    void declare_parameters(dealii::ParameterHandler &prm);

    /// For Boost's archives.
    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &local_solver &interface.form &interface.preconditioner &interface.coarse_space
          &complementarity &contact_tolerance;
    }
  };
} // namespace taut

#endif
