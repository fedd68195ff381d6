// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_report_h
#define taut_scene_report_h

#include <taut/model/scene_bodies.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /// Where points of a scene are in space [m].
  struct ScenePlaces
  {
    std::vector<Coordinates> from, to; ///< of each link; of a ground without a place, zero
    std::vector<Coordinates> loads, probes;
    std::vector<std::vector<Coordinates>> cables; ///< a line for each body; of other types, none
  };

  /// At U = 0, on cables at the displacements @p U if these are given. Called by all ranks
  /// together, with the same result.
  ScenePlaces places_in_space(const Scene &scene, const SceneBodies &bodies,
                              const BodyVectors *U = nullptr);

  /// The scene as understood: tables of wires, supports, masses, springs, links, loads and probes,
  /// with units. Places on cables are arc lengths, with the place in space behind them.
  void print_scene(const Scene &scene, const ScenePlaces &places, std::ostream &out);

  /// The geometry at U = 0 along x and y as an SVG drawing, heights exaggerated if the scene is
  /// much longer than high. Throws UserError.
  void write_sketch(const Scene &scene, const ScenePlaces &places, const std::string &path);
} // namespace taut

#endif
