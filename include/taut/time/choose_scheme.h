// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_choose_scheme_h
#define taut_choose_scheme_h

#include <taut/interface/contact_rows.h>
#include <taut/time/integrator.h>
#include <taut/time/solver_parameters.h>

#include <string>

namespace taut
{
  /// A time integration scheme by name, and why.
  struct SchemeChoice
  {
    std::string name;
    std::string reason;
  };

  /**
   * The scheme that suits the rows of a scene at a step [s]. A one-sided row behaves as compliant
   * when its S_ii is at least its (B^T A^-1 B)_ii, or when the wire's node there carries no mass.
   * Without rigid one-sided rows: generalised-alpha. With them, its multipliers fail, and the
   * choice is BDF2 where waves cross at least a quarter of an element a step, and the source's
   * scheme below that.
   */
  SchemeChoice choose_scheme(const Scene &scene, const Structure &structure,
                             const ContactRows &rows, const SolverParameters &parameters,
                             double step);

  /**
   * Throws an EntryError on Time/Scheme if a scheme is known to fail on a row of the scene: a rigid
   * one-sided row on a wire whose waves cross fewer elements a step than the scheme needs there, or
   * Moreau-Jean of velocities without damping beside nodes without mass.
   */
  void check_scheme(const TimeIntegrator &integrator, const Scene &scene,
                    const Structure &structure, const ContactRows &rows,
                    const SolverParameters &parameters, double step);
} // namespace taut

#endif
