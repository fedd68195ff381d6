// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_write_file_h
#define taut_write_file_h

#include <string>

namespace taut
{
  /// Replaces the file @p path by a file with these bytes. If the program ends meanwhile or fails,
  /// the file is the old file or the new file. A device or pipe is written directly. Throws
  /// UserError if the file could not be written; the old file then remains.
  void write_file(const std::string &path, const std::string &bytes);

  /// As write_file(), and safe if the machine ends meanwhile: waits until the new file is on the
  /// disk.
  void replace_file(const std::string &path, const std::string &bytes);

  /// A name beside @p path that no other process takes, on any machine of the disk; another one in
  /// each call.
  std::string unfinished_name(const std::string &path);

  /// Puts a file of that name, whose bytes are on the disk, in the place of @p path, as
  /// replace_file().
  void finish_file(const std::string &unfinished, const std::string &path);
} // namespace taut

#endif
