// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_check_joints_h
#define taut_check_joints_h

#include <taut/model/scene_bodies.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * Throws EntryError for links and loads on cables that have no effect, as a held end takes them:
   * a link neither of whose ends moves along it, and a load that acts at a held end, whose reaction
   * no table has. Returns the names of the links that act at a held end and at something that
   * moves: to these the cable is the ground. Called by all ranks together, with the same result.
   */
  std::vector<std::string> check_held_ends(const Scene &scene, const SceneBodies &bodies);

  /**
   * Throws EntryError for a ball joint of a parameter file between two places that are apart at
   * U = 0 by more than a thousandth of the length of the shorter body (the radius of gyration of a
   * rigid one, the diagonal of the box around the surface of others), or, between masses and places
   * of the ground, by more than a millionth of their distance from the origin: the message says
   * where they are. Bodies of types that show no surface may be anywhere. Called by all ranks
   * together.
   */
  void check_ball_joints(const Scene &scene, const SceneBodies &bodies);
} // namespace taut

#endif
