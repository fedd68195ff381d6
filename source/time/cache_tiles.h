// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cache_tiles_h
#define taut_cache_tiles_h

#include <taut/substructure/substructure.h>

#include <algorithm>

namespace taut
{
  /// Rows of a tile: their part of all vectors fits in the nearest cache. A multiple of all block
  /// sizes and vector widths; all rows if the matrices have no blocks.
  inline std::size_t tile_size(const Substructure &body)
  {
    constexpr std::size_t n_rows = 480;
    return body.mass().block_size() == 0 ? body.n_dofs()
                                         : std::min<std::size_t>(body.n_dofs(), n_rows);
  }

  /// Calls work(begin, end, reached) for each tile of rows. Products of rows begin to end - 1 with
  /// the matrices of the body read nothing from `reached` on.
  template <typename Work>
  void visit_tiles(const Substructure &body, const Work &work)
  {
    constexpr std::size_t reach = 12; // two nodes of the largest blocks, those of cables
    const std::size_t n = body.n_dofs(), size = tile_size(body);
    for (std::size_t begin = 0; begin < n; begin += size)
    {
      const std::size_t end = std::min(n, begin + size);
      work(begin, end, std::min(n, end + reach));
    }
  }
} // namespace taut

#endif
