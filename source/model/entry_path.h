// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_entry_path_h
#define taut_entry_path_h

#include <string>

namespace taut
{
  /// Of an entry in the section of an item; empty for an item that a program made.
  inline std::string entry_path(const std::string &origin, const std::string &entry)
  {
    return origin.empty() ? "" : origin + "/" + entry;
  }
} // namespace taut

#endif
