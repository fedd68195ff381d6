// SPDX-License-Identifier: LGPL-2.1-or-later
// The fault of this process.
#ifndef tests_faults_fault_h
#define tests_faults_fault_h

#include <dlfcn.h>

#include <cfenv>

namespace faults
{
  enum class Counted
  {
    nothing,
    files,
    collectives
  };
  struct Fault
  {
    const char *name;
    Counted counted;
    int error; ///< errno of that call; 0: none
    bool cuts, stays;
    int rounding = FE_TONEAREST;
  };
  /// Calls of the counted kind, and those that failed.
  struct Numbers
  {
    long counted, failed;
  };

  extern Fault fault;
  extern long at;           ///< number of the call that fails
  extern Numbers *numbers;  ///< in memory that the process sees that forked this one
  extern int log_file;      ///< of operations on files
  extern char folder[4096]; ///< its own files are counted, with a '/' at its end

  /// Counts a call. True if it is to fail.
  bool is_due(Counted what);

  /// The function that a call would have gone to.
  template <typename Function>
  Function *next(const char *name)
  {
    return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
  }
} // namespace faults

#endif
