// SPDX-License-Identifier: LGPL-2.1-or-later
#include "program/command_line.h"

#include <taut/base/communicator.h>
#include <taut/base/exceptions.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <thread>

namespace
{
  /// Becomes 'mpirun -np N' of the same command, without its --jobs. Returns if there is no mpirun.
  void become_parallel(const int argc, char **argv, const unsigned int n)
  {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe");
    std::vector<std::string> words = {"mpirun", "-np", std::to_string(n), program};
    for (int i = 1; i < argc; ++i)
    {
      const std::string word = argv[i];
      if (word == "-j" || word == "--jobs")
        ++i;
      else if (word.compare(0, 2, "-j") != 0 && word.compare(0, 7, "--jobs=") != 0)
        words.push_back(word);
    }
    std::vector<char *> pointers;
    for (std::string &word : words)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);
    // One core a worker, also of more workers than there are cores, and also of root, with Open MPI
    // 4 and 5; what the user has set stays.
    for (const auto &[variable, value] :
         std::initializer_list<std::pair<const char *, const char *>>{
             {"OPENBLAS_NUM_THREADS", "1"},
             {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
             {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
             {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
             {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"}})
      setenv(variable, value, 0);
    // A worker that waits gives its core to another: Open MPI 5 does so on demand only.
    if (n > std::thread::hardware_concurrency())
      setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    execvp("mpirun", pointers.data());
  }

  int work(const int argc, char **argv)
  {
    const taut::CommandLine line = taut::read_command_line(argc, argv);
    // Of many processes only the root speaks: that takes MPI.
    if (taut::started_in_parallel())
      return taut::run(line);
    if (!line.mistake.empty())
      throw taut::UserError(line.mistake);
    if (!line.answer.empty())
    {
      if (!(std::cout << line.answer << std::flush))
        throw taut::UserError("cannot write the answer: the disk is full, or its reader is gone");
      return 0;
    }
    if (line.jobs > 1)
    {
      become_parallel(argc, argv, line.jobs);
      throw taut::UserError("cannot start 'mpirun' for --jobs: install Open MPI, or run "
                            "without --jobs");
    }
    return taut::run(line);
  }
} // namespace

int main(const int argc, char **argv)
{
  try
  {
    return work(argc, argv);
  }
  catch (const std::bad_alloc &)
  {
    std::cerr << "taut: " << taut::too_large << '\n';
    std::_Exit(1); // the destructors of some libraries need memory
  }
  catch (const std::exception &e)
  {
    std::cerr << "taut: " << e.what() << '\n';
  }
  return 1;
}
