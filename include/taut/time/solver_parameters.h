// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solver_parameters_h
#define taut_solver_parameters_h

#include <taut/interface/interface_parameters.h>

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Names and numbers of the solvers in a step.
  struct SolverParameters
  {
    std::string local_solver = "block tridiagonal"; ///< see make_local_solver()
    InterfaceParameters interface;
    std::string complementarity = "semismooth Newton"; ///< or "energy-ordered"
    double contact_tolerance = 1e-8;                   ///< bound of Certificate::max() [1]

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
