// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_part_h
#define taut_scene_part_h

#include <taut/scene/scene.h>

#include <vector>

namespace taut
{
  /// A part of a scene, whose wires, masses and bodies are numbered anew.
  struct ScenePart
  {
    Scene scene;
    /// Number in the part of each wire, mass and body of the whole scene; `ground` if the item is
    /// not in the part.
    std::vector<std::size_t> wire, mass, body;

    /// An attachment of the whole scene that is in the part.
    Attachment inside(Attachment end) const;
  };

  /**
   * The part of a scene that determines the equilibrium of @p points: the wires, masses and bodies
   * that springs and fixed links connect with one of these points, with their supports, links and
   * loads. Probes and sliding contacts are left out. Items keep their order.
   */
  ScenePart connected_part(Scene scene, const std::vector<Attachment> &points);

  /// The scene of one wire, number 0, with all data that a WireComponent reads. Links are left out
  /// unless they take mass from the wire.
  Scene wire_part(const Scene &scene, std::size_t wire);
} // namespace taut

#endif
