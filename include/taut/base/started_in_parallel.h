// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_started_in_parallel_h
#define taut_started_in_parallel_h

#include <cstdlib>
#include <initializer_list>

namespace taut
{
  /// True if mpirun or a similar program started this program. Starting MPI to ask it costs as much
  /// as a short run.
  inline bool started_in_parallel()
  {
    for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"})
      if (std::getenv(name))
        return true;
    return false;
  }
} // namespace taut

#endif
