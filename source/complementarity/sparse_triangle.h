// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sparse_triangle_h
#define taut_sparse_triangle_h

#include <taut/base/sparse_cholesky.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// The lower triangle of a sparse symmetric matrix whose values change more often than its
  /// pattern: row after row with ascending columns, and the diagonal apart.
  struct SparseTriangle
  {
    /// An entry beside the diagonal, as seen from one of its two rows.
    struct Neighbour
    {
      unsigned int row;  ///< the other row
      std::size_t entry; ///< index in `value`
    };

    std::vector<std::size_t> begin; ///< first entry of each row, and the end
    std::vector<unsigned int> column;
    std::vector<double> value;
    std::vector<double> diagonal;

    /// The entries of each row in both triangles.
    std::vector<std::size_t> neighbours_begin;
    std::vector<Neighbour> neighbours;

    std::size_t size() const { return diagonal.size(); }

    /// Pattern of @p entries in @p n rows, with zero values.
    void set_pattern(std::size_t n, SymmetricEntries entries);

    /// Sets the values; entries of one position add. Returns false, with zero values, if the
    /// pattern lacks a position. Allocates nothing.
    bool set_values(const SymmetricEntries &entries);
  };
} // namespace taut

#endif
