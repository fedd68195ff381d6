// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_choose_scheme_h
#define taut_choose_scheme_h

#include "time/contact_resolution.h"
#include <taut/time/integrator.h>
#include <taut/time/step_parameters.h>

#include <functional>

namespace taut
{
  /**
   * The scheme that suits the constraints of a system. Generalised-alpha with spectral radius 0.8
   * suits a linear system if a step resolves all unilateral constraints. A system is not linear
   * with nonlinear bodies, laws, or constraints that turn. All other systems take Moreau-Jean with
   * conditions on gaps, then velocities, or on gaps alone where a mass matrix has no inverse.
   * Throws an EntryError if no constraint can have the @p restitution [1].
   */
  SchemeChoice choose_scheme(const Structure &structure, const Constraints &constraints,
                             const ContactResolution &resolution, double restitution);

  /**
   * Throws an EntryError if a scheme is known to fail. The entry is Time/Scheme if its forces ring
   * (StepCoefficients::ringing) at a unilateral constraint that acts as rigid, with nonlinear
   * bodies, or with turning constraints. It is Time/Moreau-Jean/Conditions if gaps of a moving
   * rigid constraint would drift, and Time/Mass redistribution if conditions on velocities without
   * damping meet a massless node. It is Time/Step if the scheme is unstable at the largest
   * frequency of the system. @p resolution is called only if the forces ring.
   */
  void check_scheme(const TimeIntegrator &integrator, const Structure &structure,
                    const Constraints &constraints,
                    const std::function<const ContactResolution &()> &resolution,
                    const SolverParameters &parameters, double step);

  /// Throws an EntryError if a scheme projects velocities and a mass matrix has no inverse.
  void check_mass(const TimeIntegrator &integrator, const Structure &structure);
} // namespace taut

#endif
