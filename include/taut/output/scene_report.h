// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_report_h
#define taut_scene_report_h

#include <taut/scene/scene.h>

#include <iosfwd>
#include <string>

namespace taut
{
  /// The scene as understood: tables of wires, supports, masses, springs, links, loads and probes,
  /// with units.
  void print_scene(const Scene &scene, std::ostream &out);

  /// The undeformed geometry as an SVG drawing, heights exaggerated if the scene is much longer
  /// than high. Throws UserError.
  void write_sketch(const Scene &scene, const std::string &path);
} // namespace taut

#endif
