// SPDX-License-Identifier: LGPL-2.1-or-later
#include "partition/cell_parts.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace taut
{
  namespace
  {
    using FaceNeighbours = std::vector<std::vector<unsigned int>>;

    FaceNeighbours face_neighbours(const BodyCells &cells)
    {
      FaceNeighbours result(cells.size());
      for (const auto &[a, b] : cells.faces)
      {
        result[a].push_back(b);
        result[b].push_back(a);
      }
      return result;
    }

    /// Connected groups of cells of one part, in the order of their first cells.
    std::vector<std::vector<unsigned int>> groups(const FaceNeighbours &neighbours,
                                                  const std::vector<unsigned int> &part)
    {
      std::vector<std::vector<unsigned int>> result;
      std::vector<char> is_known(part.size(), 0);
      for (unsigned int start = 0; start < part.size(); ++start)
      {
        if (is_known[start])
          continue;
        result.push_back({start});
        is_known[start] = 1;
        for (std::size_t i = 0; i < result.back().size(); ++i)
          for (const unsigned int next : neighbours[result.back()[i]])
            if (!is_known[next] && part[next] == part[start])
            {
              is_known[next] = 1;
              result.back().push_back(next);
            }
      }
      return result;
    }
  } // namespace

  void visit_neighbours(const BodyCells &cells,
                        const std::function<void(unsigned int, unsigned int, unsigned int)> &visit)
  {
    // Cells at DoF d: at_dof[begin[d]] to at_dof[begin[d + 1] - 1], ascending.
    std::vector<std::size_t> begin(cells.is_determined.size() + 1, 0);
    for (const unsigned int dof : cells.dofs)
      ++begin[dof + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::size_t> next = begin;
    std::vector<unsigned int> at_dof(cells.dofs.size()), lower;
    for (unsigned int c = 0; c < cells.size(); ++c)
    {
      lower.clear();
      for (std::size_t e = cells.begin[c]; e < cells.begin[c + 1]; ++e)
      {
        const unsigned int dof = cells.dofs[e];
        lower.insert(lower.end(), at_dof.begin() + static_cast<std::ptrdiff_t>(begin[dof]),
                     at_dof.begin() + static_cast<std::ptrdiff_t>(next[dof]));
        at_dof[next[dof]++] = c;
      }
      std::sort(lower.begin(), lower.end());
      for (auto first = lower.begin(); first != lower.end();)
      {
        const auto last = std::upper_bound(first, lower.end(), *first);
        visit(c, *first, static_cast<unsigned int>(last - first));
        first = last;
      }
    }
  }

  void connect_parts(const BodyCells &cells, std::vector<unsigned int> &part, unsigned int &n_parts)
  {
    const FaceNeighbours neighbours = face_neighbours(cells);
    for (;;)
    {
      const auto all = groups(neighbours, part);
      std::vector<std::size_t> largest(n_parts, all.size());
      for (std::size_t g = 0; g < all.size(); ++g)
      {
        std::size_t &best = largest[part[all[g].front()]];
        if (best == all.size() || all[g].size() > all[best].size())
          best = g;
      }
      bool has_changed = false;
      unsigned int n_new = n_parts;
      for (std::size_t g = 0; g < all.size(); ++g)
      {
        const unsigned int own = part[all[g].front()];
        if (largest[own] == g)
          continue;
        std::map<unsigned int, unsigned int> faces;
        for (const unsigned int cell : all[g])
          for (const unsigned int other : neighbours[cell])
            if (part[other] != own)
              ++faces[part[other]];
        unsigned int to = n_new, most = 0;
        for (const auto &[other, n] : faces)
          if (n > most)
          {
            most = n;
            to = other;
          }
        n_new += to == n_new;
        for (const unsigned int cell : all[g])
          part[cell] = to;
        has_changed = true;
      }
      n_parts = n_new;
      if (!has_changed)
        return;
    }
  }
} // namespace taut
