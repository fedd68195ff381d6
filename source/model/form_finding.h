// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_form_finding_h
#define taut_form_finding_h

#include <taut/base/communicator.h>
#include <taut/scene/scene.h>
#include <taut/time/step_parameters.h>

namespace taut
{
  struct SharedParts;

  /**
   * The scene without its sliding contacts. A mass that only a sliding contact may hold, because
   * only other masses and the ground are connected with it, gets a joint to the ground instead, in
   * the direction of the contact.
   */
  Scene without_sliding_contacts(Scene scene);

  /**
   * Form finding: finds the lengths of the droppers with FormFinding::find_length. In static
   * equilibrium without_sliding_contacts() their `to` ends then have the prescribed displacement.
   * There are two stages: the prescribed heights as bilateral constraints give the tensions; the
   * `from` bodies under these tensions give the lengths. The stages repeat until the lengths
   * converge to rounding, if stiffness and weight depend on the lengths. Where the direction is
   * found, too, each dropper is in line with its tension in the static state. A dropper that turns
   * out of this line is pulled back by tension over length [N/m], taut or slack (the geometric
   * stiffness, the force density of H.-J. Schek, Comput. Methods Appl. Mech. Engrg. 3 (1974)). A
   * dropper of a given length, whose direction alone is found, is a link that turns in this state.
   *
   * Returns the scene with gap, length, stiffness and direction of these links, and with half of
   * the mass of each link on each of its ends. A form of one rank comes from @p shared if it is
   * known there. The ranks share the work on long lines, and call it together. Throws UserError
   * naming the dropper if a tension is negative or a length is not positive.
   */
  Scene find_lengths(Scene scene, const SolverParameters &parameters,
                     const Communicator &processes = Communicator(), SharedParts *shared = nullptr);
} // namespace taut

#endif
