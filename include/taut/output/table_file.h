// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_table_file_h
#define taut_table_file_h

#include <taut/base/growing_file.h>

#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /// A table that grows line by line, after the header line of a CSV file. Whatever fails, the file
  /// ends with a complete line.
  class TableFile
  {
  public:
    /// Creates the file; one that @p goes_on is left as it is until resume(). Throws UserError if
    /// it cannot.
    TableFile(const std::string &path, const std::vector<std::string> &columns, bool goes_on);

    /// Adds to the current line.
    void add(const char *bytes, const std::size_t n) { buffer.append(bytes, n); }
    void add(const std::string &bytes) { buffer += bytes; }

    /// Call it where the current line is complete, whatever ends a line. Throws UserError when the
    /// disk is full.
    void end_line();

    /// Writes what is buffered and closes. Throws UserError when the disk is full.
    void close();

    /// Brings what is buffered to the disk and returns the length of the file. Throws UserError
    /// when the disk is full.
    std::size_t save();

    /// Goes on after this length and drops what follows. Throws UserError if the file is shorter.
    void resume(std::size_t length);

  private:
    void write();

    std::string path;
    GrowingFile file;
    std::string buffer;
  };
} // namespace taut

#endif
