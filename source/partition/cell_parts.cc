// SPDX-License-Identifier: LGPL-2.1-or-later
#include "partition/cell_parts.h"

#include <algorithm>
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

  std::vector<std::map<unsigned int, unsigned int>> cell_neighbours(const BodyCells &cells)
  {
    std::vector<std::vector<unsigned int>> at_dof(cells.n_dofs());
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (std::size_t e = cells.begin[c]; e < cells.begin[c + 1]; ++e)
        at_dof[cells.dofs[e]].push_back(c);
    std::vector<std::map<unsigned int, unsigned int>> result(cells.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (std::size_t e = cells.begin[c]; e < cells.begin[c + 1]; ++e)
        for (const unsigned int other : at_dof[cells.dofs[e]])
          if (other != c)
            ++result[c][other];
    return result;
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
