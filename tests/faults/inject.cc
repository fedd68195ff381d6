// SPDX-License-Identifier: LGPL-2.1-or-later
// A library for LD_PRELOAD that runs a program again and again, each time with one fault: it takes
// the place of main(), and for each line "<fault> <n> <folder>" of the standard input forks a
// process that runs the program in that folder until its n-th operation on a file of that folder
// fails. Counting begins with the program's own main(), after all libraries have been initialised.
// Outputs go to <folder>.out and <folder>.err, the operations on files to <folder>.log; the answer
// to a line is "<status of waitpid> <calls that were counted> <calls that failed>".
//
// Faults, of files: EIO and ENOSPC (that call alone fails), short (half of the bytes are written,
// the call after it has ENOSPC), full (the disk is full from then on: files shrink and change, but
// do not grow). Counted only: files. No faults, but another rounding: up, down, to_zero,
// to_nearest.
//
// A program that mpirun starts is run as it is. The variable TAUT_FAULT, "<fault> <n> <rank>",
// gives one rank its fault: an exception in its n-th collective call of MPI,
// throw for one that the program knows nothing of and throw_user for a taut::UserError. That rank
// appends the number of its calls in a run without a fault to the file TAUT_FAULT_COUNT.
#include "fault.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace faults
{
  namespace
  {
    Numbers own_numbers = {0, 0};
  }

  Fault fault = {"", Counted::nothing, 0, false, false};
  long at = 0;
  Numbers *numbers = &own_numbers;
  int log_file = -1;
  char folder[4096];

  bool is_due(const Counted what)
  {
    if (fault.counted != what)
      return false;
    const long n = ++numbers->counted;
    return fault.error != 0 && (n == at || (fault.stays && n >= at));
  }
} // namespace faults

namespace
{
  using namespace faults;

  constexpr unsigned int patience = 150; ///< of a run; it ends by SIGALRM [s]

  constexpr Fault all_faults[] = {{"files", Counted::files, 0, false, false},
                                  {"EIO", Counted::files, EIO, false, false},
                                  {"ENOSPC", Counted::files, ENOSPC, false, false},
                                  {"short", Counted::files, ENOSPC, true, false},
                                  {"full", Counted::files, ENOSPC, false, true},
                                  {"collectives", Counted::collectives, 0, false, false},
                                  {"throw", Counted::collectives, EIO, false, false},
                                  {"throw_user", Counted::collectives, EINVAL, false, false},
                                  {"to_nearest", Counted::nothing, 0, false, false},
                                  {"up", Counted::nothing, 0, false, false, FE_UPWARD},
                                  {"down", Counted::nothing, 0, false, false, FE_DOWNWARD},
                                  {"to_zero", Counted::nothing, 0, false, false, FE_TOWARDZERO}};

  using Main = int(int, char **, char **);
  Main *program = nullptr;

  [[noreturn]] void run(const Fault &wanted, const long n, const std::string &where, int argc,
                        char **argv, char **environment)
  {
    constexpr int how = O_WRONLY | O_CREAT | O_TRUNC;
    dup2(syscall(SYS_openat, AT_FDCWD, "/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(syscall(SYS_openat, AT_FDCWD, (where + ".out").c_str(), how, 0666), STDOUT_FILENO);
    dup2(syscall(SYS_openat, AT_FDCWD, (where + ".err").c_str(), how, 0666), STDERR_FILENO);
    log_file = syscall(SYS_openat, AT_FDCWD, (where + ".log").c_str(), how, 0666);
    if (chdir(where.c_str()) != 0 || getcwd(folder, sizeof folder - 1) == nullptr)
      _exit(99);
    std::strcat(folder, "/");
    alarm(patience);
    std::fesetround(wanted.rounding);
    at = n;
    fault = wanted;
    std::exit(program(argc, argv, environment));
  }

  /// The program as one of many ranks, with the fault of this one.
  int run_rank(int argc, char **argv, char **environment)
  {
    char name[32];
    int rank = 0;
    const char *const text = std::getenv("TAUT_FAULT");
    if (text != nullptr && std::sscanf(text, "%31s %ld %d", name, &at, &rank) == 3 &&
        rank == std::atoi(std::getenv("OMPI_COMM_WORLD_RANK")))
      for (const Fault &known : all_faults)
        if (std::strcmp(known.name, name) == 0)
          fault = known;
    alarm(patience);
    return program(argc, argv, environment);
  }

  int serve(int argc, char **argv, char **environment)
  {
    numbers = static_cast<Numbers *>(
        mmap(nullptr, sizeof(Numbers), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    char text[4096];
    // No standard streams: their buffers would be the children's too.
    const auto read_line = [&]
    {
      std::size_t length = 0;
      while (length + 1 < sizeof text && read(STDIN_FILENO, text + length, 1) == 1 &&
             text[length] != '\n')
        ++length;
      text[length] = '\0';
      return length > 0;
    };
    while (read_line())
    {
      char name[32], where[4000];
      long n = 0;
      if (std::sscanf(text, "%31s %ld %3999[^\n]", name, &n, where) != 3)
        return 99;
      *numbers = {0, 0};
      const pid_t child = fork();
      if (child == 0)
      {
        for (const Fault &known : all_faults)
          if (std::strcmp(known.name, name) == 0)
            run(known, n, where, argc, argv, environment);
        _exit(99);
      }
      int status = -1;
      waitpid(child, &status, 0);
      const int length = std::snprintf(text, sizeof text, "%d %ld %ld\n", status, numbers->counted,
                                       numbers->failed);
      syscall(SYS_write, STDOUT_FILENO, text, length);
    }
    _exit(0);
  }
} // namespace

extern "C"
{
  int __libc_start_main(Main *main, int argc, char **argv, void (*begin)(), void (*end)(),
                        void (*unload)(), void *stack)
  {
    using Start = int(Main *, int, char **, void (*)(), void (*)(), void (*)(), void *);
    program = main;
    return next<Start>("__libc_start_main")(std::getenv("TAUT_FAULTS") != nullptr ? serve
                                            : std::getenv("OMPI_COMM_WORLD_RANK") != nullptr
                                                ? run_rank
                                                : main,
                                            argc, argv, begin, end, unload, stack);
  }
}
