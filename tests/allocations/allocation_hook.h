// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_allocations_allocation_hook_h
#define taut_allocations_allocation_hook_h

#include <string>
#include <vector>

/// Counts the allocations of a program that links this file: malloc, calloc, realloc and the
/// aligned forms, of all its libraries and through operator new.
namespace allocations
{
  /// Number of allocations of all threads so far.
  long count();

  /// A place in the program from which memory was allocated.
  struct Site
  {
    long count;                       ///< allocations from there
    std::vector<std::string> callers; ///< names of the functions of Taut, innermost first
  };

  /// From now on the allocations of this thread are kept by their call stacks. It makes them slow.
  void start_recording();

  /// Ends the recording. The sites since its start, most frequent first, told apart by @p n_callers
  /// functions at most.
  std::vector<Site> stop_recording(std::size_t n_callers);
} // namespace allocations

#endif
