// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_check_joints_h
#define taut_check_joints_h

#include <taut/model/scene_bodies.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * Throws EntryError for links and loads on cables without effect, because a held end takes their
   * force: a link whose ends do not move along it, and a load at a held end, whose reaction no
   * table has. Returns the names of links between a held end and a place that moves: to these links
   * the cable is the ground. Called by all ranks together, with the same result.
   */
  std::vector<std::string> check_held_ends(const Scene &scene, const SceneBodies &bodies);

  /**
   * Throws EntryError for a ball joint of a parameter file whose two places are apart at U = 0; the
   * message says where they are. The tolerance is a thousandth of the length of the shorter body:
   * the radius of gyration of a rigid body, the diagonal of the box around the surface of other
   * bodies. Between masses and places of the ground it is a millionth of their distance from the
   * origin. Bodies without a surface are not checked. Called by all ranks together.
   */
  void check_ball_joints(const Scene &scene, const SceneBodies &bodies);
} // namespace taut

#endif
