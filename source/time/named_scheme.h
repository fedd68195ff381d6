// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_named_scheme_h
#define taut_named_scheme_h

#include <taut/time/integrator.h>
#include <taut/time/step_parameters.h>

#include <map>
#include <memory>
#include <string>

namespace taut
{
  /// make_integrator() for names and entries in a program. Throws UserError with the nearest known
  /// name for an unknown scheme or entry, and for an unsuitable value.
  std::unique_ptr<TimeIntegrator>
  make_named_scheme(const std::string &name, const std::map<std::string, std::string> &entries);

  /// Sets an entry by its path from the current subsection of the handler. False, without changes,
  /// if it is not declared. Throws the exceptions of the handler for an unsuitable value.
  bool set_declared_entry(const std::string &path, const std::string &value,
                          dealii::ParameterHandler &prm);

  /// Throws UserError for an unknown solver, or a tolerance that a parameter file cannot have.
  void check_solver_names(const SolverParameters &parameters);
} // namespace taut

#endif
