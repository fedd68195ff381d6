// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_interface_parameters_h
#define taut_interface_parameters_h

#include <string>

namespace taut
{
  /// Names of the form of F and of the solver for its systems.
  struct InterfaceParameters
  {
    /// "assembled dense", "assembled sparse", "matrix-free", or "automatic" for the form that suits
    /// number of constraints and step.
    std::string form = "automatic";

    /// For the matrix-free form: "diagonal" or "Dirichlet".
    std::string preconditioner = "Dirichlet";

    /// For the matrix-free form: "rigid body modes" of the floating bodies, or "none".
    std::string coarse_space = "rigid body modes";

    /// Entries of the largest factor, of the preconditioner or of a coarse problem, that each of
    /// several ranks has whole (doc/decomposition.md).
    unsigned int largest_whole_factor = 20000000;
  };
} // namespace taut

#endif
