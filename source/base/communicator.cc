// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/memory.h"
#include <taut/base/communicator.h>
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

namespace taut
{
  namespace
  {
    /// Numbers or letters in a message; MPI counts them by an int.
    constexpr std::size_t largest_message = 1 << 28;

    /// An exception in a form that can be sent.
    struct Failure
    {
      enum Kind : int
      {
        none,
        user,
        entry,
        not_held,
        memory,
        internal
      };
      int kind = none;
      std::string entry_path, message;

      [[noreturn]] void raise() const
      {
        if (kind == entry)
          throw EntryError(entry_path, message);
        if (kind == not_held)
          throw BodyNotHeld(message, {}, entry_path);
        if (kind == memory)
          throw std::bad_alloc();
        if (kind == internal)
          throw std::runtime_error(message);
        throw UserError(message);
      }
    };

    Failure run(const std::function<void()> &work)
    {
      try
      {
        work();
      }
      catch (const BodyNotHeld &e)
      {
        return {Failure::not_held, e.entry(), e.message()};
      }
      catch (const EntryError &e)
      {
        return {Failure::entry, e.entry(), e.message()};
      }
      catch (const UserError &e)
      {
        return {Failure::user, "", e.what()};
      }
      catch (const std::exception &e)
      {
        if (is_memory_shortage(e))
          return {Failure::memory, "", ""};
        return {Failure::internal, "", e.what()};
      }
      return {};
    }

    void broadcast_from(const int rank, const MPI_Comm processes, std::string &text)
    {
      unsigned long length = text.size();
      MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG, rank, processes);
      text.resize(length);
      for (std::size_t begin = 0; begin < text.size(); begin += largest_message)
        MPI_Bcast(text.data() + begin,
                  static_cast<int>(std::min(text.size() - begin, largest_message)), MPI_CHAR, rank,
                  processes);
    }
  } // namespace

  void start_mpi()
  {
    int is_done = 0;
    MPI_Initialized(&is_done);
    if (is_done)
      return;
    MPI_Init(nullptr, nullptr);
    std::atexit(
        []
        {
          int is_over = 0;
          MPI_Finalized(&is_over);
          if (!is_over)
            MPI_Finalize();
        });
  }

  Communicator::Communicator(const MPI_Comm processes) : processes(processes)
  {
    int value = 0;
    MPI_Comm_rank(processes, &value);
    own_rank = value;
    MPI_Comm_size(processes, &value);
    n_ranks = value;
  }

  void Communicator::sum(double *values, std::size_t n) const
  {
    if (n_ranks == 1)
      return;
    for (; n > 0; values += std::min(n, largest_message), n -= std::min(n, largest_message))
      MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(std::min(n, largest_message)),
                    MPI_DOUBLE, MPI_SUM, processes);
  }

  double Communicator::max(double value) const
  {
    if (n_ranks == 1)
      return value;
    // MPI_MAX does not define the result for not-a-number.
    double both[2] = {std::isnan(value) ? 0. : value, std::isnan(value) ? 1. : 0.};
    MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_DOUBLE, MPI_MAX, processes);
    return both[1] > 0. ? std::numeric_limits<double>::quiet_NaN() : both[0];
  }

  void Communicator::max(std::vector<double> &values) const
  {
    for (std::size_t first = 0; n_ranks > 1 && first < values.size(); first += largest_message)
      MPI_Allreduce(MPI_IN_PLACE, values.data() + first,
                    static_cast<int>(std::min(values.size() - first, largest_message)), MPI_DOUBLE,
                    MPI_MAX, processes);
  }

  void Communicator::gather(const std::size_t value, std::vector<std::size_t> &all) const
  {
    static_assert(sizeof(std::size_t) == sizeof(unsigned long), "MPI knows it by this type");
    all.assign(n_ranks, value);
    if (n_ranks > 1)
      MPI_Allgather(&value, 1, MPI_UNSIGNED_LONG, all.data(), 1, MPI_UNSIGNED_LONG, processes);
  }

  std::vector<std::string> Communicator::gather(const std::string &text) const
  {
    std::vector<std::string> all(n_ranks);
    all[own_rank] = text;
    for (unsigned int rank = 0; rank < n_ranks && n_ranks > 1; ++rank)
      broadcast_from(static_cast<int>(rank), processes, all[rank]);
    return all;
  }

  void Communicator::broadcast(std::string &text) const
  {
    if (n_ranks > 1)
      broadcast_from(0, processes, text);
  }

  void Communicator::agree_with_others(const std::function<void()> &work) const
  {
    Failure failure = run(work);
    int first =
        failure.kind == Failure::none ? static_cast<int>(n_ranks) : static_cast<int>(own_rank);
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, processes);
    if (first == static_cast<int>(n_ranks))
      return;
    MPI_Bcast(&failure.kind, 1, MPI_INT, first, processes);
    broadcast_from(first, processes, failure.entry_path);
    broadcast_from(first, processes, failure.message);
    failure.raise();
  }
} // namespace taut
