// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/rank_abort.h"

#include <chrono>
#include <thread>

namespace taut
{
  namespace
  {
    /// Waiting time: an error of all ranks reaches them within the additional work of one rank.
    constexpr std::chrono::seconds patience{5};
    constexpr std::chrono::milliseconds pause{10};
  } // namespace

  RankAbort::RankAbort(const Communicator &all) : is_root(all.is_root())
  {
    // A communicator of its own, so that messages of interrupted work are not mistaken for its
    // messages.
    if (all.size() > 1)
      MPI_Comm_dup(MPI_COMM_WORLD, &processes);
  }

  bool RankAbort::are_own()
  {
    if (processes == MPI_COMM_NULL)
      return true;
    MPI_Request request;
    MPI_Ibarrier(processes, &request);
    int all_came = 0;
    const auto begin = std::chrono::steady_clock::now();
    while (!all_came && std::chrono::steady_clock::now() - begin < patience)
    {
      MPI_Test(&request, &all_came, MPI_STATUS_IGNORE);
      std::this_thread::sleep_for(pause);
    }
    are_of_all = all_came != 0;
    return is_root || !are_of_all;
  }

  void RankAbort::end_others(const int code) const
  {
    if (!are_of_all)
      MPI_Abort(processes, code);
  }
} // namespace taut
