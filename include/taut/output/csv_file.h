// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_csv_file_h
#define taut_csv_file_h

#include <fstream>
#include <string>
#include <vector>

namespace taut
{
  /// A table with a header line. Numbers are written as short as possible without loss.
  class CsvFile
  {
  public:
    /// Creates the file. Throws UserError if it cannot.
    CsvFile(const std::string &path, const std::vector<std::string> &columns);

    /// Adds a cell to the current line.
    CsvFile &operator<<(double value);
    CsvFile &operator<<(const std::string &text);

    /// Ends the current line. Throws UserError when the disk is full.
    void end_line();

    /// Writes what is buffered and closes. Throws UserError when the disk is full.
    void close();

  private:
    void write();

    std::string path;
    std::ofstream file;
    std::string buffer;
    bool line_begins = true;
  };
} // namespace taut

#endif
