// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rank_abort_h
#define taut_rank_abort_h

#include <taut/base/communicator.h>

namespace taut
{
  /**
   * Ends the ranks of a program after an error. The error may be that of all ranks, or of one rank
   * for which the others wait without knowing. All ranks make the object together, before anything
   * may fail.
   */
  class RankAbort
  {
  public:
    /// @p processes must live as long as this object.
    explicit RankAbort(const Communicator &processes);

    /// True if this rank has to report the error: the first rank if all ranks call the function,
    /// otherwise each rank that calls it. Needs no memory of its own.
    bool are_own();

    /// Ends the ranks that did not call are_own(), and this rank, with this exit code.
    void end_others(int code) const;

  private:
    MPI_Comm processes = MPI_COMM_NULL; ///< null: one process alone
    bool is_root = true, are_of_all = true;
  };
} // namespace taut

#endif
