// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_gather_entries_h
#define taut_gather_entries_h

#include <taut/base/communicator.h>
#include <taut/base/sparse_cholesky.h>

namespace taut
{
  /// Gathers the entries of a matrix over constraints: all ranks get the entries of all ranks, in
  /// the order of the ranks.
  inline void gather(const Communicator &processes, MatrixEntries &entries)
  {
    if (processes.size() == 1)
      return;
    std::vector<std::size_t> sizes;
    processes.gather(entries.size(), sizes);
    std::size_t first = 0, all = 0;
    for (std::size_t rank = 0; rank < sizes.size(); ++rank)
    {
      first += rank < processes.rank() ? sizes[rank] : 0;
      all += sizes[rank];
    }
    std::vector<double> packed(3 * all, 0.);
    for (std::size_t k = 0; k < entries.size(); ++k)
    {
      double *const entry = packed.data() + 3 * (first + k);
      entry[0] = entries.row[k];
      entry[1] = entries.column[k];
      entry[2] = entries.value[k];
    }
    processes.sum(packed);
    entries = {};
    for (std::size_t k = 0; k < all; ++k)
      entries.add(static_cast<std::size_t>(packed[3 * k]),
                  static_cast<std::size_t>(packed[3 * k + 1]), packed[3 * k + 2]);
  }
} // namespace taut

#endif
