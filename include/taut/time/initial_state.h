// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_initial_state_h
#define taut_initial_state_h

#include <taut/base/start.h>
#include <taut/interface/constraints.h>
#include <taut/time/residuals.h>
#include <taut/time/state.h>
#include <taut/time/step_parameters.h>

#include <string>

namespace taut
{
  /// The start of a run, the reference of its motions, and the residuals of the equilibrium.
  struct InitialState
  {
    Reference reference;
    State state;
    BodyVectors loads; ///< external forces minus those of the reference [N, N m]
    Residuals residuals;
    std::vector<char> linearised; ///< for each body of all ranks: was linearised here
    std::vector<double> kept;     ///< forces of links that keep their direction from here on [N]
    std::string repeated_joints;  ///< names of those at rest, see RepeatedRows
  };

  /**
   * The start of a run at t = 0. An equilibrium is the reference itself, with U = 0; otherwise the
   * undeformed system is the reference. Given displacements and velocities come from
   * Substructure::initial_state(). Prescribed DoFs start where they are at t = 0, with the
   * velocity that their motion has there; it is differentiated as for steps of length @p step [s].
   *
   * Bodies to be linearised move by large amounts until the reference is found. Then linear bodies
   * replace them in @p structure, see SlenderBody::linearised(). At an equilibrium this also
   * linearises the turning constraints if none pushes and all their ends are on such bodies or
   * fixed, see Constraints::keep_directions(). Throws the errors of static_equilibrium(), and an
   * EntryError if a rigid unilateral constraint starts with a penetration. Called by all ranks
   * together.
   */
  InitialState find_initial_state(Structure &structure, Constraints &constraints,
                                  const SolverParameters &parameters, Start start, double step);
} // namespace taut

#endif
