// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_dealt_numbers_h
#define taut_dealt_numbers_h

#include <taut/base/communicator.h>

#include <deal.II/base/mpi.h>

#include <cstddef>
#include <map>
#include <vector>

namespace taut
{
  /**
   * Numbers below n_numbers, such as those of DoFs, dealt to the ranks in stretches. Who knows a
   * number, but not which ranks share it, asks the rank to which it leads: no rank needs a list of
   * all numbers.
   */
  class DealtNumbers
  {
  public:
    /// For each rank what it is told, or tells.
    using Messages = std::map<unsigned int, std::vector<unsigned int>>;

    DealtNumbers(const Communicator &processes, const std::size_t n_numbers)
        : processes(processes), n_numbers(n_numbers)
    {
    }

    unsigned int rank_of(const unsigned int number) const
    {
      return static_cast<unsigned int>(static_cast<std::size_t>(number) * processes.size() /
                                       n_numbers);
    }

    /// Sends the messages, and returns those of other ranks to this one. Called by all ranks
    /// together.
    Messages exchange(const Messages &sent) const
    {
      return dealii::Utilities::MPI::some_to_some(processes.of_mpi(), sent);
    }

  private:
    const Communicator processes;
    const std::size_t n_numbers;
  };
} // namespace taut

#endif
