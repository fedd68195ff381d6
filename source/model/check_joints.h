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
   * The vector between the two places of a link of a ball joint at U = 0 [m]: 0 for other links,
   * at a ground without a place, and up to rounding, a billionth of the shorter body, or a
   * millionth at a cable that does not start at rest, which its weight stretches. The length of a
   * body is the radius of gyration of a rigid body, the diagonal of the box around the surface of
   * other bodies; that of masses and places of the ground is their distance from the origin. Called
   * by all ranks together.
   */
  Coordinates distance_of_tie(const Scene &scene, const SceneBodies &bodies, std::size_t link);

  /**
   * Throws EntryError for a ball joint of a parameter file whose two places are apart at U = 0, if
   * the start does not close it: a start at rest closes distances up to a thousandth of the shorter
   * body, between masses and places of the ground up to a millionth of their distance from the
   * origin. The message says the distance and where they are. Called by all ranks together.
   */
  void check_ball_joints(const Scene &scene, const SceneBodies &bodies);

  /// A warning of rigid bodies that joints along some fixed directions hold together at two places
  /// or more; empty: there are none. Such joints are a hinge until both bodies have turned.
  std::string warning_of_joints(const Scene &scene);
} // namespace taut

#endif
