// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/csv_table.h"
#include "base/data_files.h"
#include "base/nearest_name.h"
#include "base/text.h"
#include <taut/base/exceptions.h>

#include <boost/tokenizer.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace taut
{
  namespace
  {
    constexpr std::size_t none = static_cast<std::size_t>(-1);
  } // namespace

  CsvTable::CsvTable(const std::string &name, const std::string &entry) : name(name), entry(entry)
  {
    std::istringstream in(*read_data_file(name, entry));
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);)
    {
      const std::string byte_order_mark = "\xEF\xBB\xBF";
      if (++number == 1 && line.compare(0, byte_order_mark.size(), byte_order_mark) == 0)
        line.erase(0, byte_order_mark.size());
      line = trim(line);
      if (line.empty() || line[0] == '#')
        continue;
      if (names.empty())
      {
        separator = line.find(';') != std::string::npos ? ';' : ',';
        names = cells_of(line);
        for (std::size_t i = 0; i < names.size(); ++i)
          if (std::count(names.begin(), names.end(), names[i]) > 1)
            throw EntryError(entry, "file '" + name + "' has two columns '" + names[i] + "'");
        continue;
      }
      rows.push_back({number, cells_of(line)});
      if (rows.back().cells.size() != names.size())
        fail(rows.size() - 1, std::to_string(rows.back().cells.size()) + " cells for " +
                                  std::to_string(names.size()) + " columns separated by '" +
                                  separator + "'");
    }
    if (rows.empty())
      throw EntryError(entry, "file '" + name +
                                  "' has no rows; its first line names the columns, and a line for "
                                  "each row follows");
  }

  std::vector<std::string> CsvTable::cells_of(const std::string &line) const
  {
    // Without an escape character, so that a backslash is itself.
    const boost::escaped_list_separator<char> format("", std::string(1, separator), "\"");
    std::vector<std::string> cells;
    for (const std::string &cell :
         boost::tokenizer<boost::escaped_list_separator<char>>(line, format))
      cells.push_back(trim(cell));
    return cells;
  }

  std::size_t CsvTable::index(const std::string &column) const
  {
    const auto found = std::find(names.begin(), names.end(), column);
    return found == names.end() ? none : found - names.begin();
  }

  bool CsvTable::has(const std::string &column) const
  {
    return index(column) != none;
  }

  const std::string &CsvTable::text(const std::size_t row, const std::string &column) const
  {
    static const std::string nothing;
    const std::size_t i = index(column);
    return i == none ? nothing : rows[row].cells[i];
  }

  double CsvTable::to_number(const std::size_t row, const std::string &column,
                             std::string text) const
  {
    if (separator == ';')
      std::replace(text.begin(), text.end(), ',', '.');
    char *end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
      fail(row, "'" + text + "' in column '" + column + "' is no number");
    return value;
  }

  double CsvTable::number(const std::size_t row, const std::string &column) const
  {
    return to_number(row, column, text(row, column));
  }

  std::vector<double> CsvTable::numbers(const std::size_t row, const std::string &column) const
  {
    std::vector<double> result;
    for (const std::string &part : split(text(row, column), ' '))
      if (!part.empty())
        result.push_back(to_number(row, column, part));
    return result;
  }

  std::vector<double> CsvTable::numbers(const std::string &column) const
  {
    if (!has(column))
      throw EntryError(entry, "file '" + name + "' has no column '" + column + "'" +
                                  suggestion(column, names));
    std::vector<double> result;
    for (std::size_t row = 0; row < n_rows(); ++row)
      result.push_back(number(row, column));
    return result;
  }

  void CsvTable::fail(const std::size_t row, const std::string &message) const
  {
    throw EntryError(entry, "file '" + name + "', line " + std::to_string(rows[row].line) + ": " +
                                message);
  }
} // namespace taut
