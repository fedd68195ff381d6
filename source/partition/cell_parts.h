// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cell_parts_h
#define taut_cell_parts_h

#include <taut/scene/partition.h>

#include <functional>
#include <vector>

namespace taut
{
  /// Hands each pair of cells with common DoFs over, the second one lower, and the number of these
  /// DoFs.
  void visit_neighbours(const BodyCells &cells,
                        const std::function<void(unsigned int, unsigned int, unsigned int)> &visit);

  /**
   * Makes each part connected by faces of its cells: a part whose groups of cells touch in a corner
   * only would move like a mechanism. The largest group of a part is kept. Every other group goes
   * to the part with which it shares the most faces. A group without a neighbour becomes a part of
   * its own; @p n_parts then grows.
   */
  void connect_parts(const BodyCells &cells, std::vector<unsigned int> &part,
                     unsigned int &n_parts);
} // namespace taut

#endif
