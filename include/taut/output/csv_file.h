// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_csv_file_h
#define taut_csv_file_h

#include <taut/output/table_file.h>

#include <array>
#include <string>
#include <vector>

namespace taut
{
  /// A time [s] as short as it was meant: to 14 digits, 0.009 for 9 steps of 0.001.
  std::string time_text(double time);

  /// A number as short as possible without loss, and a text, quoted if it has to be.
  std::string csv_number(double value);
  std::string csv_cell(const std::string &text);

  /// A table with a header line. Numbers are written as short as possible without loss. Whatever
  /// fails, the file ends with a complete line.
  class CsvFile
  {
  public:
    /// Creates the file; one that @p goes_on is left as it is until resume(). Throws UserError if
    /// it cannot.
    CsvFile(const std::string &path, const std::vector<std::string> &columns, bool goes_on = false);

    /// Adds a cell to the current line.
    CsvFile &operator<<(double value);
    CsvFile &operator<<(const std::string &text);

    /// Begins a line with a time [s].
    CsvFile &begin_line(double time);

    /// Ends the current line. Throws UserError when the disk is full.
    void end_line();

    /// As those of TableFile.
    void close() { table.close(); }
    std::size_t save() { return table.save(); }
    void resume(const std::size_t length) { table.resume(length); }

  private:
    /// A comma and a number.
    struct Number
    {
      explicit Number(double value);

      double value;
      char text[32];
      std::size_t length;
    };

    TableFile table;
    bool line_begins = true;

    /// The last two numbers: a value, its least and its largest are often two.
    std::array<Number, 2> last = {Number(0.), Number(0.)};
  };
} // namespace taut

#endif
