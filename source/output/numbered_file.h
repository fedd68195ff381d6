// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_numbered_file_h
#define taut_numbered_file_h

#include <cstddef>
#include <cstdio>
#include <string>

namespace taut
{
  /// The name of a file of a series, such as wires_00012.vtu.
  inline std::string numbered(const std::string &name, const std::size_t number,
                              const char *const ending = ".vtu")
  {
    char text[32];
    std::snprintf(text, sizeof text, "_%05zu", number);
    return name + text + ending;
  }
} // namespace taut

#endif
