// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/rows_of_blocks.h"
#include "base/groups.h"

#include <algorithm>
#include <set>

namespace taut
{
  /// Rows of a block may be on ranks that do not know each other: the ranks first agree on the
  /// smallest number of each block, and its owner then tells them all rows.
  std::vector<std::size_t> rows_of_blocks(const RowMap &owners, const MatrixEntries &products,
                                          const std::size_t n_rows)
  {
    const Communicator &processes = owners.communicator();
    const std::vector<std::size_t> &held = owners.held();
    const auto position = [&](const int number)
    {
      return std::lower_bound(held.begin(), held.end(), static_cast<std::size_t>(number)) -
             held.begin();
    };
    Groups groups(held.size());
    std::vector<char> is_seen(held.size(), 0);
    for (std::size_t e = 0; e < products.size(); ++e)
    {
      const auto row = position(products.row[e]), column = position(products.column[e]);
      groups.join(row, column);
      is_seen[row] = is_seen[column] = 1;
    }
    const std::vector<std::vector<std::size_t>> members = groups.members();
    std::vector<double> block(held.begin(), held.end());
    for (bool is_changed = true; is_changed;)
    {
      const std::vector<double> before = block;
      for (const std::vector<std::size_t> &rows : members)
      {
        double smallest = block[rows.front()];
        for (const std::size_t p : rows)
          smallest = std::min(smallest, block[p]);
        for (const std::size_t p : rows)
          block[p] = smallest;
      }
      owners.take_smallest(block);
      is_changed = processes.any(block != before);
    }

    MatrixEntries rows; // of blocks
    std::set<std::size_t> seen, wanted(owners.owned().begin(), owners.owned().end());
    for (std::size_t p = 0; p < owners.owned().size(); ++p)
    {
      const std::size_t at = owners.position_of_owned(p);
      is_seen[at] = 1;
      rows.add(static_cast<std::size_t>(block[at]), held[at], 1.);
    }
    for (std::size_t p = 0; p < held.size(); ++p)
      if (is_seen[p])
        seen.insert(static_cast<std::size_t>(block[p]));
    wanted.insert(seen.begin(), seen.end());
    RowMap(owners, {wanted.begin(), wanted.end()}).sum_entries(rows, n_rows);
    std::set<std::size_t> result(owners.owned().begin(), owners.owned().end());
    for (std::size_t e = 0; e < rows.size(); ++e)
      if (seen.count(rows.row[e]) > 0)
        result.insert(rows.column[e]);
    return {result.begin(), result.end()};
  }
} // namespace taut
