// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_report_h
#define taut_scene_report_h

#include <taut/model/scene_bodies.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /// Places of points of a scene in space [m].
  struct ScenePlaces
  {
    /// From end to end of each link, with its rings; zero for a ground without a place.
    std::vector<std::vector<Coordinates>> links;
    std::vector<Coordinates> loads, probes;
    std::vector<std::vector<Coordinates>> cables; ///< a line for each body; empty for other types
  };

  /// Places at U = 0; on cables at the displacements @p U if given. Called by all ranks together,
  /// with the same result.
  ScenePlaces places_in_space(const Scene &scene, const SceneBodies &bodies,
                              const BodyVectors *U = nullptr);

  /// Prints the scene as read: tables of wires, supports, masses, springs, links, loads and probes,
  /// with units. Places on cables are arc lengths, followed by places in space.
  void print_scene(const Scene &scene, const ScenePlaces &places, std::ostream &out);
} // namespace taut

#endif
