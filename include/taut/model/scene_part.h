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
    /// Number in the part of each wire, mass and body of the whole scene; `ground` if it is not
    /// there.
    std::vector<std::size_t> wire, mass, body;

    /// An attachment of the whole scene that is in the part.
    Attachment inside(Attachment end) const;
  };

  /**
   * What decides about the rest of these points: the wires, masses and bodies that springs and
   * fixed links connect with one of @p points, with all that acts on them. Probes and sliding
   * contacts are left out.
   */
  ScenePart connected_part(const Scene &scene, const std::vector<Attachment> &points);

  /// One wire with all that a WireComponent reads: its number is 0. Of links only those that take
  /// mass from it are there.
  Scene wire_part(const Scene &scene, std::size_t wire);
} // namespace taut

#endif
