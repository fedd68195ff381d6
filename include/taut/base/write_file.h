// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_write_file_h
#define taut_write_file_h

#include <string>

namespace taut
{
  /// Writes a text and a line end to a file. Throws UserError if not all of it could be written.
  void write_file(const std::string &path, const std::string &text);
} // namespace taut

#endif
