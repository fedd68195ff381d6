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
    std::vector<char> linearised; ///< for each body of all ranks whether it was, there
    std::size_t n_kept = 0;       ///< constraints that turn no more but keep the direction there
  };

  /**
   * The start of a run at t = 0. An equilibrium is the reference itself, so that U = 0; otherwise
   * the reference is the undeformed system. Given displacements and velocities are those of
   * Substructure::initial_state(); prescribed DoFs start without velocity.
   *
   * Bodies that are to be linearised move by large amounts until the reference is found. Then
   * linear ones take their place in @p structure, see SlenderBody::linearised(). At an equilibrium
   * constraints that turn are linearised with them, if all of them have their ends on such bodies
   * or stand and none pushes: see Constraints::keep_directions(). Throws what static_equilibrium()
   * throws, and an EntryError if a rigid unilateral constraint starts with a penetration. Called by
   * all ranks together.
   */
  InitialState find_initial_state(Structure &structure, Constraints &constraints,
                                  const SolverParameters &parameters, Start start);
} // namespace taut

#endif
