// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_sketch_h
#define taut_scene_sketch_h

#include "output/scene_report.h"

#include <string>

namespace taut
{
  /// Draws the geometry at U = 0 along x and y as SVG, with one scale for both, or with exaggerated
  /// heights if the scene is much longer than high. A link from the ground goes to its place there
  /// or, without one, along its direction to the lowest point of the scene. A solid is drawn by its
  /// surface, a body without a surface by lines between the places of its links. Throws UserError.
  void write_sketch(const Scene &scene, const ScenePlaces &places, const std::string &path);
} // namespace taut

#endif
