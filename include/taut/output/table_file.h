// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_table_file_h
#define taut_table_file_h

#include <taut/base/growing_file.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /// A time [s] in at most 14 digits: 0.009 for 9 steps of 0.001.
  std::string time_text(double time);

  /// Shortest text of a number without loss; a text, quoted if necessary.
  std::string csv_number(double value);
  std::string csv_cell(const std::string &text);

  /// Format of tables of numbers.
  enum class TableFormat
  {
    csv,   ///< text, with the shortest numbers without loss
    binary ///< the header line of a CSV file, then all numbers as doubles of this machine
  };

  /// A table with a header line that grows by lines. It ends with a complete line after failures.
  class TableFile
  {
  public:
    /// Creates the file; if it @p goes_on, leaves it for resume(). Throws UserError on failure.
    TableFile(const std::string &path, const std::vector<std::string> &columns,
              bool goes_on = false, TableFormat format = TableFormat::csv);

    /// The file @p stem.csv or @p stem.bin; throws UserError likewise.
    TableFile(TableFormat format, const std::string &stem, const std::vector<std::string> &columns,
              bool goes_on = false);

    /// Adds a cell to the current line; text only to a CSV file.
    TableFile &operator<<(double value);
    TableFile &operator<<(const std::string &text);

    /// Begins a line with a time [s].
    TableFile &begin_line(double time);

    /// Ends the current line. Throws UserError if the disk is full.
    void end_line();

    /// Adds a line: a time [s] and a value for each other column. Throws as end_line().
    void add_line(double time, const std::vector<double> &values);

    /// Writes the buffer and closes. Throws UserError if the disk is full.
    void close();

    /// Writes the buffer and returns the length of the file. Throws UserError if the disk is full.
    std::size_t save();

    /// Continues at this length and drops the rest. Throws UserError if the file is shorter.
    void resume(std::size_t length);

  private:
    /// A comma and a number.
    struct Number
    {
      explicit Number(double value);

      double value;
      char text[32];
      std::size_t length;
    };

    void add_bytes(const double *values, std::size_t n);
    void write();

    std::string path;
    TableFormat format;
    GrowingFile file;
    std::string buffer;
    bool line_begins = true;

    /// Cache of two numbers: a value, its least and its largest often are two numbers.
    std::array<Number, 2> last = {Number(0.), Number(0.)};
  };
} // namespace taut

#endif
