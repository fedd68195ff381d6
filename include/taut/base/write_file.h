// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_write_file_h
#define taut_write_file_h

#include <string>

namespace taut
{
  /// Puts a file with these bytes in the place of @p path: if the program ends meanwhile or fails,
  /// the file is the old one or the new one. A device or pipe is written as it is. Throws UserError
  /// if it could not be written; the old one stays then.
  void write_file(const std::string &path, const std::string &bytes);

  /// The same if the machine ends meanwhile: waits until the new file is on the disk.
  void replace_file(const std::string &path, const std::string &bytes);
} // namespace taut

#endif
