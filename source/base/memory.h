// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_memory_h
#define taut_memory_h

#include <exception>
#include <sstream>
#include <string>

namespace taut
{
  /// True for std::bad_alloc and similar exceptions, also of deal.II.
  bool is_memory_shortage(const std::exception &e);

  /// The text of a stream. Streams swallow std::bad_alloc and end their text: here it is thrown.
  std::string whole_text(const std::ostringstream &stream);
} // namespace taut

#endif
