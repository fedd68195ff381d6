// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rows_of_blocks_h
#define taut_rows_of_blocks_h

#include <taut/interface/row_map.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * All rows of those blocks of a matrix in which this rank has @p products, entries between rows
   * that it holds, and its owned rows, ascending. Blocks are rows that entries of any rank join.
   * Called by all ranks together.
   */
  std::vector<std::size_t> rows_of_blocks(const RowMap &owners, const MatrixEntries &products,
                                          std::size_t n_rows);
} // namespace taut

#endif
