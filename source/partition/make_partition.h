// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_make_partition_h
#define taut_make_partition_h

#include "base/tuned_blas.h"
#include <taut/scene/partition.h>

#include <string>

namespace taut
{
  /**
   * Cuts the wires and the bodies of a scene (domain decomposition) by one of three methods.
   *
   * - 'METIS' parts the graph of all grid nodes and cells into parts of about equal work. Edges of
   *   the graph are elements and links, and pairs of cells with common nodes, weighted by the
   *   number of these nodes. The cut of a wire moves to the nearest node without a link or support.
   *   The cells of a part are connected by faces.
   * - 'wires': every wire is a part, and bodies are not cut.
   * - 'given': wires are cut at the listed positions, moved to the nearest node. Every piece is a
   *   part, and bodies are not cut.
   *
   * Cells of a distributed body are parted by their ranks, into parts of their own. Called by all
   * ranks together. Throws EntryError.
   */
  Partition make_partition(const Scene &scene, const PartitionParameters &parameters);

  /// Lets the ranks of a run of @p n_steps steps share the meshes of bodies that will be cut into
  /// at least one part for each rank. Called by all ranks together, before anything else is asked
  /// for of the bodies. Throws EntryError on all ranks.
  void distribute_bodies(const Scene &scene, const PartitionParameters &parameters, double n_steps,
                         const Communicator &processes, bool tuned_blas = has_tuned_blas());

  /// A number of parts, and why.
  struct NumberOfParts
  {
    unsigned int n = 1;
    std::string reason;
  };

  /// The number of parts of `Number of substructures = automatic` in a run of @p n_steps steps, 0
  /// in statics (doc/decomposition.md): solids in space are cut if a few solutions cost less than
  /// one factor of the uncut solid.
  NumberOfParts automatic_number_of_parts(const Scene &scene, double n_steps,
                                          bool tuned_blas = has_tuned_blas());
} // namespace taut

#endif
