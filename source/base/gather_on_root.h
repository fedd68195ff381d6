// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_gather_on_root_h
#define taut_gather_on_root_h

#include <taut/base/communicator.h>

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace taut
{
  /// The numbers of all ranks in order, on the root; others get none. Called by all ranks together.
  inline void gather_on_root(const Communicator &processes, const std::vector<double> &own,
                             std::vector<double> &all)
  {
    if (processes.size() == 1)
    {
      all = own;
      return;
    }
    std::vector<std::size_t> sizes;
    processes.gather(own.size(), sizes);
    std::vector<int> n, first;
    std::size_t sum = 0; // of which MPI takes the first places as int
    for (const std::size_t size : sizes)
    {
      n.push_back(static_cast<int>(size));
      first.push_back(static_cast<int>(sum));
      sum += size;
    }
    if (sum > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw std::runtime_error("there are more numbers than MPI gathers on one rank: write the "
                               "motion with fewer points, or none (Output/Field interval = 0)");
    all.resize(processes.is_root() ? sum : 0);
    MPI_Gatherv(own.data(), n[processes.rank()], MPI_DOUBLE, all.data(), n.data(), first.data(),
                MPI_DOUBLE, 0, processes.of_mpi());
  }
} // namespace taut

#endif
