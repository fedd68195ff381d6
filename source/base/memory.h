// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_memory_h
#define taut_memory_h

#include <exception>

namespace taut
{
  /**
   * For a program, not for a library: from now on memory_was_short() knows of every allocation that
   * failed. Streams of the standard library swallow std::bad_alloc and end their text or input.
   * Other libraries turn it into an error of their own. The output, or the message, is then wrong.
   */
  void watch_memory();

  /// True if an allocation has failed since the last call. False without watch_memory().
  bool memory_was_short();

  /// Throws std::bad_alloc if memory_was_short().
  void check_memory();

  /// True for std::bad_alloc and similar exceptions, also of deal.II.
  bool is_memory_shortage(const std::exception &e);
} // namespace taut

#endif
