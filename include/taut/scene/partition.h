// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_partition_h
#define taut_scene_partition_h

#include <taut/scene/scene.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * How the wires of a scene are cut, as plain values: a cut is at a node of a wire's grid, so that
   * cutting never changes the mesh. Every piece belongs to one of the parts.
   */
  struct Partition
  {
    /// A piece of a wire: the nodes from `first` to the first node of the next piece, or to the
    /// end.
    struct Piece
    {
      std::size_t first = 0; ///< index in grid(scene, wire)
      unsigned int part = 0;
    };
    std::vector<std::vector<Piece>> wires; ///< at least one piece a wire, in ascending order
    unsigned int n_parts = 1;

    std::size_t n_cuts() const;
  };

  /// All wires whole, in one part.
  Partition whole(const Scene &scene);
} // namespace taut

#endif
