// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_choose_scheme_h
#define taut_choose_scheme_h

#include <taut/interface/constraints.h>
#include <taut/time/integrator.h>
#include <taut/time/solver_parameters.h>

#include <map>
#include <string>
#include <vector>

namespace taut
{
  /// A time integration scheme by name, values of its own entries by path, and why.
  struct SchemeChoice
  {
    std::string name;
    std::map<std::string, std::string> entries;
    std::string reason;
  };

  /// Unilateral constraints that act as rigid at a step [s]: less compliant than the bodies in one
  /// step. One on DoFs without mass is as compliant as the elements beside them.
  std::vector<std::size_t> rigid_constraints(const Structure &structure,
                                             const Constraints &constraints,
                                             const SolverParameters &parameters, double step);

  /**
   * The scheme that suits the constraints of a system at a step [s], the shortest of a run. A
   * unilateral constraint acts as rigid when its S_ii is less than its (B^T A^-1 B)_ii, unless it
   * acts on DoFs without mass. Without such constraints generalised-alpha with spectral radius 0.8,
   * otherwise Moreau-Jean with conditions on gaps, then velocities, or on gaps alone where a mass
   * matrix has no inverse. Throws an EntryError if a @p restitution [1] is asked for that no
   * constraint could have.
   */
  SchemeChoice choose_scheme(const Structure &structure, const Constraints &constraints,
                             const SolverParameters &parameters, double step, double restitution);

  /**
   * Throws an EntryError if a scheme is known to fail on a constraint: on Time/Scheme if its forces
   * ring (StepCoefficients::ringing) at a unilateral constraint that acts as rigid, on
   * Time/Moreau-Jean/Conditions if gaps of a moving rigid constraint would drift, on Time/Mass
   * redistribution where conditions on velocities without damping meet a node without mass, on
   * Time/Step if the scheme is not stable for the largest frequency of the system.
   */
  void check_scheme(const TimeIntegrator &integrator, const Structure &structure,
                    const Constraints &constraints, const SolverParameters &parameters,
                    double step);

  /// Throws an EntryError if a scheme projects velocities and a mass matrix has no inverse.
  void check_mass(const TimeIntegrator &integrator, const Structure &structure, double step);
} // namespace taut

#endif
