// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_named_scheme_h
#define taut_named_scheme_h

#include <taut/time/integrator.h>
#include <taut/time/solver_parameters.h>

#include <map>
#include <memory>
#include <string>

namespace taut
{
  /**
   * make_integrator() for names and entries that a program gives. Throws UserError, with the
   * nearest name that there is, for a scheme or an entry that is not known, and for a value that
   * does not fit.
   */
  std::unique_ptr<TimeIntegrator>
  make_named_scheme(const std::string &name, const std::map<std::string, std::string> &entries);

  /// Throws UserError for a name that no solver has, or a tolerance that a parameter file could not
  /// have.
  void check_solver_names(const SolverParameters &parameters);
} // namespace taut

#endif
