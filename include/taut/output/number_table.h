// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_number_table_h
#define taut_number_table_h

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// How tables of numbers are written.
  enum class TableFormat
  {
    csv,   ///< as text, see CsvFile
    binary ///< the header line of a CSV file, then all numbers as doubles of this machine
  };

  /// A file of numbers in time that grows line by line. Whatever fails, it ends with a complete
  /// line. All functions throw UserError when the disk is full.
  class NumberTable
  {
  public:
    virtual ~NumberTable() = default;

    /// Adds a line: a time [s] and a value for each other column.
    virtual void add_line(double time, const std::vector<double> &values) = 0;

    /// Brings what is buffered to the disk and returns the length of the file.
    virtual std::size_t save() = 0;

    /// Goes on after this length and drops what follows. Throws UserError if the file is shorter.
    virtual void resume(std::size_t length) = 0;

    /// Writes what is buffered and closes.
    virtual void close() = 0;
  };

  /**
   * Creates the file @p stem.csv, or @p stem.bin, with the names of all its columns, that of the
   * time first; one that @p goes_on is left as it is until resume(). Throws UserError if it cannot.
   */
  std::unique_ptr<NumberTable> make_number_table(TableFormat format, const std::string &stem,
                                                 const std::vector<std::string> &columns,
                                                 bool goes_on = false);
} // namespace taut

#endif
