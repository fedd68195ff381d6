// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_gather_entries_h
#define taut_gather_entries_h

#include <taut/base/communicator.h>
#include <taut/base/sparse_cholesky.h>

#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

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
    if (std::accumulate(sizes.begin(), sizes.end(), std::size_t(0)) >
        static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw std::runtime_error(
          "a matrix over the constraints has more entries than MPI gathers: cut "
          "the model into fewer parts");
    const std::vector<int> n(sizes.begin(), sizes.end());
    std::vector<int> first(1, 0);
    std::partial_sum(n.begin(), n.end(), std::back_inserter(first));
    const auto all_of = [&](auto &values, MPI_Datatype type)
    {
      std::remove_reference_t<decltype(values)> all(first.back());
      MPI_Allgatherv(values.data(), static_cast<int>(values.size()), type, all.data(), n.data(),
                     first.data(), type, processes.of_mpi());
      values = std::move(all);
    };
    all_of(entries.row, MPI_INT);
    all_of(entries.column, MPI_INT);
    all_of(entries.value, MPI_DOUBLE);
  }
} // namespace taut

#endif
