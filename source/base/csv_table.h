// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_csv_table_h
#define taut_csv_table_h

#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /**
   * A table of a file: names of the columns in its first line, then a line for each row. Columns
   * are separated by semicolons if the first line has one, else by tabs, else by commas. Cells may
   * be quoted. With semicolons or tabs numbers may have a decimal comma. A byte order mark, empty
   * lines, empty cells at the ends of lines, and lines that begin with '#' do not count. Lines end
   * as on any machine.
   *
   * A column is found by its name as written, or else without regard to capitals and to a unit of
   * SI in brackets behind it: 'span' finds 'Span [m]'. Throws EntryError for a unit that is none,
   * as the numbers would be too large or too small.
   */
  class CsvTable
  {
  public:
    /// Reads a file by read_data_file(). @p name is relative to the folder of the parameter file.
    /// Throws EntryError on
    /// @p entry, which names the file, if it cannot be read or a line has another number of cells
    /// than the first.
    CsvTable(const std::string &name, const std::string &entry);

    const std::vector<std::string> &columns() const { return names; }
    /// Names in small letters without units.
    std::vector<std::string> heads() const;

    std::size_t n_rows() const { return rows.size(); }

    /// Whether a row of empty cells stands behind the last row. Other empty rows do not count.
    bool has_empty_end() const { return is_empty_last; }
    bool has(const std::string &column) const;

    /// A cell without spaces around it; empty if there is no such column or row. Rows count from 0.
    const std::string &text(std::size_t row, const std::string &column) const;

    /// The number of a cell. Throws EntryError that names the line if it is none, or not finite.
    double number(std::size_t row, const std::string &column) const;

    /// The numbers of a cell, with spaces between them.
    std::vector<double> numbers(std::size_t row, const std::string &column) const;

    /// All numbers of a column. Throws EntryError if there is no such column.
    std::vector<double> numbers(const std::string &column) const;

    /// An EntryError about a row.
    [[noreturn]] void fail(std::size_t row, const std::string &message) const;

  private:
    void read_line(std::size_t number, const std::string &line);
    std::vector<std::string> cells_of(const std::string &line) const;
    std::size_t index(const std::string &column) const;
    double to_number(std::size_t row, const std::string &column, std::string text) const;

    struct Row
    {
      std::size_t line; ///< of the file, from 1
      std::vector<std::string> cells;
    };
    std::string name, entry;
    char separator = ',';
    std::vector<std::string> names;
    std::vector<Row> rows;
    bool is_empty_last = false;
  };
} // namespace taut

#endif
