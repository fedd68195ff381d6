// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rank_abort_h
#define taut_rank_abort_h

#include <taut/base/communicator.h>

namespace taut
{
  /**
   * How the ranks of a program end after an error, which may be that of all of them or of one that
   * the others know nothing of and wait for. Made by all ranks together, before anything may fail.
   */
  class RankAbort
  {
  public:
    /// @p processes live as long as this.
    explicit RankAbort(const Communicator &processes);

    /// True if this rank is the one to say what went wrong: the first of all ranks if all of them
    /// come here, and each that does come otherwise. Needs no memory of its own.
    bool are_own();

    /// Ends the ranks that did not come to are_own(), and this one with them, with this exit code.
    void end_others(int code) const;

  private:
    MPI_Comm processes = MPI_COMM_NULL; ///< null: one process alone
    bool is_root = true, are_of_all = true;
  };
} // namespace taut

#endif
