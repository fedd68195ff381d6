// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_partition_h
#define taut_scene_partition_h

#include <taut/scene/divisible_body.h>
#include <taut/scene/scene.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace taut
{
  /**
   * How the wires and the bodies of a scene are cut (domain decomposition). A wire is cut at nodes
   * of its grid, a body along faces of its cells, so that cutting never changes the mesh. Every
   * piece belongs to one part.
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

    /// How a custom body is cut; without `body` it is not cut.
    struct Division
    {
      std::shared_ptr<const DivisibleBody> body;
      std::vector<unsigned int> part; ///< part of each cell
    };
    std::vector<Division> bodies; ///< one for each custom body, or empty

    unsigned int n_parts = 1;

    /// Number of cuts of wires.
    std::size_t n_cuts() const;
  };

  /// The partition without cuts: all wires and bodies in one part.
  Partition whole(const Scene &scene);
} // namespace taut

#endif
