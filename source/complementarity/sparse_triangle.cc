// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/sparse_triangle.h"

#include <algorithm>
#include <utility>

namespace taut
{
  void SparseTriangle::set_pattern(const std::size_t n, SymmetricEntries entries)
  {
    entries.compress();
    diagonal.assign(n, 0.);
    begin.assign(n + 1, 0);
    column.clear();
    neighbours_begin.assign(n + 2, 0);
    for (std::size_t e = 0; e < entries.size(); ++e)
    {
      const unsigned int i = entries.row[e], j = entries.column[e];
      if (i == j)
        continue;
      column.push_back(j);
      ++begin[i + 1];
      ++neighbours_begin[i + 2];
      ++neighbours_begin[j + 2];
    }
    value.assign(column.size(), 0.);
    neighbours.resize(2 * column.size());
    for (std::size_t i = 0; i < n; ++i)
    {
      begin[i + 1] += begin[i];
      neighbours_begin[i + 2] += neighbours_begin[i + 1];
    }
    for (unsigned int i = 0; i < n; ++i)
      for (std::size_t e = begin[i]; e < begin[i + 1]; ++e)
      {
        neighbours[neighbours_begin[i + 1]++] = {column[e], e};
        neighbours[neighbours_begin[column[e] + 1]++] = {i, e};
      }
    neighbours_begin.pop_back();
  }

  bool SparseTriangle::set_values(const SymmetricEntries &entries)
  {
    std::fill(value.begin(), value.end(), 0.);
    std::fill(diagonal.begin(), diagonal.end(), 0.);
    for (std::size_t e = 0; e < entries.size(); ++e)
    {
      const unsigned int i = entries.row[e], j = entries.column[e];
      if (i == j)
      {
        diagonal[i] += entries.value[e];
        continue;
      }
      const auto first = column.begin() + begin[i], last = column.begin() + begin[i + 1],
                 at = std::lower_bound(first, last, j);
      if (at == last || *at != j)
      {
        std::fill(value.begin(), value.end(), 0.);
        return false;
      }
      value[at - column.begin()] += entries.value[e];
    }
    return true;
  }
} // namespace taut
