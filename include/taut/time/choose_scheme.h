// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_choose_scheme_h
#define taut_choose_scheme_h

#include <taut/time/contact_resolution.h>
#include <taut/time/integrator.h>
#include <taut/time/solver_parameters.h>

#include <functional>
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

  /**
   * The scheme that suits the constraints of a system. Where a step resolves all unilateral
   * constraints, generalised-alpha with spectral radius 0.8; otherwise, and for bodies that are not
   * linear, laws and constraints that turn, Moreau-Jean with conditions on gaps, then velocities,
   * or on gaps alone where a mass matrix has no inverse. Throws an EntryError if a @p restitution
   * [1] is asked for that no constraint could have.
   */
  SchemeChoice choose_scheme(const Structure &structure, const Constraints &constraints,
                             const ContactResolution &resolution, double restitution);

  /**
   * Throws an EntryError if a scheme is known to fail on a constraint: on Time/Scheme if its forces
   * ring (StepCoefficients::ringing) at a unilateral constraint that acts as rigid, on
   * Time/Moreau-Jean/Conditions if gaps of a moving rigid constraint would drift, on Time/Mass
   * redistribution where conditions on velocities without damping meet a node without mass, on
   * Time/Step if the scheme is not stable for the largest frequency of the system. @p resolution is
   * asked for if the forces of the scheme may ring.
   */
  void check_scheme(const TimeIntegrator &integrator, const Structure &structure,
                    const Constraints &constraints,
                    const std::function<const ContactResolution &()> &resolution,
                    const SolverParameters &parameters, double step);

  /// Throws an EntryError if a scheme projects velocities and a mass matrix has no inverse.
  void check_mass(const TimeIntegrator &integrator, const Structure &structure, double step);
} // namespace taut

#endif
