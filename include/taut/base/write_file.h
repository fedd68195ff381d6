// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_write_file_h
#define taut_write_file_h

#include <string>

namespace taut
{
  /// Writes a text and a line end to a file. Throws UserError if not all of it could be written.
  void write_file(const std::string &path, const std::string &text);

  /// Puts a file with these bytes in the place of @p path: whatever happens meanwhile, the file is
  /// the old one or the new one, on the disk. Throws UserError if it could not be written; the old
  /// one stays then.
  void replace_file(const std::string &path, const std::string &bytes);
} // namespace taut

#endif
