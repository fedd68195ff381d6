// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_communicator_h
#define taut_communicator_h

#include <mpi.h>

#include <cstddef>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace taut
{
  /// Initialises MPI unless it is initialised already; MPI then ends with the program.
  void start_mpi();

  /**
   * The processes (ranks) that run a scene together, by value. Bodies are distributed over the
   * ranks. Vectors with one number per constraint are on all ranks: each rank has the share of its
   * own bodies, and sum() adds the shares.
   *
   * One process needs no MPI: no function then calls it.
   */
  class Communicator
  {
  public:
    /// This process alone.
    Communicator() = default;

    /// MPI must be initialised, and live as long as this object.
    explicit Communicator(MPI_Comm processes);

    unsigned int rank() const { return own_rank; }
    unsigned int size() const { return n_ranks; }
    bool is_root() const { return own_rank == 0; }

    /// For libraries that take one; MPI_COMM_NULL for a process alone.
    MPI_Comm of_mpi() const { return processes; }

    /// Each entry becomes its sum over all ranks, the same number on all of them.
    void sum(double *values, std::size_t n) const;
    void sum(std::vector<double> &values) const { sum(values.data(), values.size()); }

    /// The largest of the values of all ranks; not-a-number if one value is.
    double max(double value) const;

    /// The same for each entry, of values that are numbers.
    void max(std::vector<double> &values) const;

    /// True if @p is_true is true on any rank.
    bool any(const bool is_true) const { return max(is_true ? 1. : 0.) > 0.; }

    /// Sets @p all to the value of each rank, in order.
    void gather(std::size_t value, std::vector<std::size_t> &all) const;

    /// The texts of all ranks, in order, on all of them.
    std::vector<std::string> gather(const std::string &text) const;

    /// The text of the root on all ranks.
    void broadcast(std::string &text) const;

    /**
     * Calls @p work, which may differ from rank to rank and must not communicate. If it throws on
     * any rank, all ranks throw the exception of the first of these ranks: a UserError with its
     * type, std::bad_alloc, or any other exception as std::runtime_error.
     */
    template <typename Work>
    void agree(const Work &work) const
    {
      if (n_ranks == 1)
        work();
      else
        agree_with_others(std::cref(work));
    }

  private:
    void agree_with_others(const std::function<void()> &work) const;

    MPI_Comm processes = MPI_COMM_NULL;
    unsigned int own_rank = 0, n_ranks = 1;
  };

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
