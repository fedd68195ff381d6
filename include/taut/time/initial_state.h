// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_initial_state_h
#define taut_initial_state_h

#include <taut/base/start.h>
#include <taut/interface/constraints.h>
#include <taut/time/certificate.h>
#include <taut/time/solver_parameters.h>
#include <taut/time/state.h>

namespace taut
{
  /// Where a run starts, what its motions are measured from, and how well the equilibrium was
  /// solved.
  struct InitialState
  {
    Reference reference;
    State state;
    Certificate certificate;
  };

  /**
   * The start of a run at t = 0. An equilibrium is the reference itself, so that U = 0; otherwise
   * the reference is the undeformed system. Given displacements and velocities are those of
   * Substructure::initial_state(). Throws what static_equilibrium() throws, and an EntryError if a
   * rigid unilateral constraint starts with a penetration. Called by all ranks together.
   */
  InitialState find_initial_state(const Structure &structure, Constraints &constraints,
                                  const SolverParameters &parameters, Start start);
} // namespace taut

#endif
