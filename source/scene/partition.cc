// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/scene/partition.h>

namespace taut
{
  std::size_t Partition::n_cuts() const
  {
    std::size_t n = 0;
    for (const auto &pieces : wires)
      n += pieces.size() - 1;
    return n;
  }

  Partition whole(const Scene &scene)
  {
    Partition partition;
    partition.wires.assign(scene.wires.size(), {Partition::Piece()});
    return partition;
  }
} // namespace taut
