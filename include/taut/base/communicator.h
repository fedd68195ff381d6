// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_communicator_h
#define taut_communicator_h

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace taut
{
  /// Initialises MPI unless that has been done; it then ends with the program.
  void start_mpi();

  /// True if the program was started by mpirun or a like of it.
  bool started_in_parallel();

  /**
   * The processes that run a scene together, by value. Bodies are distributed over them, everything
   * that has one number a row is on all of them: what a process knows of a row from its own bodies
   * is its share, and sum() makes the whole of it.
   *
   * One process needs no MPI: none of the functions then calls it.
   */
  class Communicator
  {
  public:
    /// This process alone.
    Communicator() = default;

    /// MPI must have been initialised, and live as long as this.
    explicit Communicator(MPI_Comm processes);

    unsigned int rank() const { return own_rank; }
    unsigned int size() const { return n_ranks; }
    bool is_root() const { return own_rank == 0; }

    /// Each entry becomes its sum over all ranks, the same number on all of them.
    void sum(double *values, std::size_t n) const;
    void sum(std::vector<double> &values) const { sum(values.data(), values.size()); }

    /// The largest of the values of all ranks; not-a-number if one is.
    double max(double value) const;

    /// True if it is on any rank.
    bool any(const bool is_true) const { return max(is_true ? 1. : 0.) > 0.; }

    /// The value of each rank, in order.
    std::vector<std::size_t> gather(std::size_t value) const;

    /// The texts of all ranks, in order, on all of them.
    std::vector<std::string> gather(const std::string &text) const;

    /// The text of the root on all ranks.
    void broadcast(std::string &text) const;

    /**
     * Calls @p work, which may differ from rank to rank and communicate with no one. If it throws
     * on any rank, all ranks throw what the first of them threw: a UserError as what it is,
     * std::bad_alloc, or anything else as std::runtime_error.
     */
    void agree(const std::function<void()> &work) const;

  private:
    MPI_Comm processes = MPI_COMM_NULL;
    unsigned int own_rank = 0, n_ranks = 1;
  };
} // namespace taut

#endif
