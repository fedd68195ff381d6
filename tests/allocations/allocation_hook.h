// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_allocations_allocation_hook_h
#define taut_allocations_allocation_hook_h

/// Counts the allocations of a program that links this file: malloc, calloc, realloc and the
/// aligned forms, of all its libraries and through operator new.
namespace allocations
{
  /// Number of allocations of all threads so far.
  long count();
} // namespace allocations

#endif
