// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_form_finding_h
#define taut_form_finding_h

#include <taut/scene/scene.h>
#include <taut/time/solver_parameters.h>

namespace taut
{
  struct SharedParts;

  /**
   * The scene with its sliding contacts taken off the wires. A mass that one of them may hold, as
   * nothing but other masses and the ground is connected with it, is held by a joint to the ground
   * in its place instead, in the direction of the contact.
   */
  Scene without_sliding_contacts(Scene scene);

  /**
   * Finds the lengths of the droppers that ask for it (Link::find_length), so that in static
   * equilibrium without_sliding_contacts() their `to` ends stand at the prescribed displacement.
   * Two stages: the prescribed heights as bilateral constraints give the tensions; the `from`
   * bodies under these tensions give the lengths. Repeated until the lengths stand still where they
   * decide about stiffness and weight. Where the direction is found, too, the static state has each
   * dropper in line with its tension; turned out of it, it is pulled back by tension over length
   * (its geometric stiffness, the force density of H.-J. Schek, Comput. Methods Appl. Mech. Engrg.
   * 3 (1974)) [N/m], taut or slack.
   *
   * Returns the scene with gap, length, stiffness and direction of these links set and half of the
   * mass of each put on each of its ends; the form comes from @p shared if it is known there.
   * Throws UserError naming the dropper if a tension is negative or a length not positive.
   */
  Scene find_lengths(Scene scene, const SolverParameters &parameters,
                     SharedParts *shared = nullptr);
} // namespace taut

#endif
