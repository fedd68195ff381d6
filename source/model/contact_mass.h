// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_mass_h
#define taut_contact_mass_h

#include <taut/scene/scene.h>
#include <taut/time/step_parameters.h>

namespace taut
{
  /// True if the node of the wire under a rigid link carries no mass (mass redistribution: H. B.
  /// Khenous, P. Laborde, Y. Renard, European J. Mech. A/Solids 27 (2008)). The force of the node
  /// then is that of its elements.
  bool is_massless(const Link &link);

  /**
   * Takes the mass from the nodes of wires at rigid stops, as Mass redistribution = mass does, if
   * the elements of these nodes are a spring that the step [s] resolves (doc/accuracy.md).
   * Conditions: all rigid unilateral links of the scene are stops on bars or strings, at least two
   * elements apart; the fastest waves cross at most four elements a step; no other link acts as
   * rigid. Throws an EntryError if a body cannot be factored.
   */
  void redistribute_contact_mass(Scene &scene, const SolverParameters &parameters, double step);
} // namespace taut

#endif
