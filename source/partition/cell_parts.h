// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cell_parts_h
#define taut_cell_parts_h

#include <taut/scene/divisible_body.h>

#include <map>
#include <vector>

namespace taut
{
  /// Of each cell the cells with which it has DoFs in common, and how many.
  std::vector<std::map<unsigned int, unsigned int>> cell_neighbours(const BodyCells &cells);

  /**
   * Makes the cells of each part hang together by faces, as parts that touch in a corner only would
   * move like a mechanism: of each part the largest group stays, the others go to the part with
   * which they share the most faces. A group without a neighbour becomes a part of its own; @p
   * n_parts then grows.
   */
  void connect_parts(const BodyCells &cells, std::vector<unsigned int> &part,
                     unsigned int &n_parts);
} // namespace taut

#endif
