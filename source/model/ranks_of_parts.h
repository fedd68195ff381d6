// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_ranks_of_parts_h
#define taut_ranks_of_parts_h

#include <taut/base/communicator.h>
#include <taut/scene/partition.h>

#include <cstddef>
#include <vector>

namespace taut
{
  bool is_divided(const Partition &partition, std::size_t body);

  /// The rank of each part, each mechanism and each custom body: stretches of their order, as parts
  /// of near numbers are near each other, along wires and by METIS's bisections. Where this is too
  /// uneven, the largest first, each to the rank with the fewest DoFs so far. Some parts have their
  /// ranks.
  std::vector<unsigned int> ranks_of_parts(const Scene &scene, const Partition &partition,
                                           const std::vector<std::vector<std::size_t>> &mechanisms,
                                           unsigned int n_ranks);

  /// The partition with the cells of this rank alone, where every rank has parts of a body
  /// (BodyType::keep_own_cells()). Called by all ranks together.
  Partition with_own_cells(const Scene &scene, Partition partition, const Communicator &processes);
} // namespace taut

#endif
