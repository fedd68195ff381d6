// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/csv_table.h"
#include "base/data_files.h"
#include "base/nearest_name.h"
#include "base/text.h"
#include "base/utf8.h"
#include <taut/base/exceptions.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/tokenizer.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <utility>

namespace taut
{
  namespace
  {
    constexpr std::size_t none = static_cast<std::size_t>(-1);

    /// What may stand in brackets behind the name of a column.
    const std::set<std::string> units_of_si = {"m",  "s",   "kg",  "N",  "rad",  "1",   "-",
                                               "Pa", "N/m", "N m", "Nm", "kg/m", "m/s", "N s/m"};

    /// "span" and "m" of "span [m]" or "span (m)".
    std::pair<std::string, std::string> head_and_unit(const std::string &name)
    {
      for (const auto &[open, close] : {std::pair('[', ']'), {'(', ')'}})
        if (const std::size_t at = name.find_last_of(open);
            !name.empty() && name.back() == close && at != std::string::npos)
          return {trim(name.substr(0, at)), trim(name.substr(at + 1, name.size() - at - 2))};
      return {name, ""};
    }

    /// Throws EntryError if the text is not in UTF-8, with what it may be in.
    void check_encoding(const std::string &text, const std::string &name, const std::string &entry)
    {
      const std::size_t end = end_of_utf8(text);
      const bool is_wide = text.find('\0') != std::string::npos;
      if (end == text.size() && !is_wide)
        return;
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(end), '\n');
      throw EntryError(
          entry, "file '" + name + "' is in another encoding than UTF-8: " +
                     (is_wide ? "in UTF-16, or no text at all"
                              : "in Windows-1252 or Latin-1, by its line " + std::to_string(line)) +
                     "; save it as CSV in UTF-8");
    }
  } // namespace

  CsvTable::CsvTable(const std::string &name, const std::string &entry) : name(name), entry(entry)
  {
    std::string text = *read_data_file(name, entry);
    check_encoding(text, name, entry);
    const std::string byte_order_mark = "\xEF\xBB\xBF";
    if (text.compare(0, byte_order_mark.size(), byte_order_mark) == 0)
      text.erase(0, byte_order_mark.size());
    boost::replace_all(text, "\r\n", "\n");
    std::replace(text.begin(), text.end(), '\r', '\n');
    std::istringstream in(text);
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);)
      read_line(++number, line);
    if (rows.empty())
      throw EntryError(entry, "file '" + name +
                                  "' has no rows; its first line names the columns, and a line for "
                                  "each row follows");
  }

  void CsvTable::read_line(const std::size_t number, const std::string &line)
  {
    const std::string content = trim(line);
    if (content.empty() || content[0] == '#')
      return;
    if (names.empty())
      for (const char possible : {',', '\t', ';'})
        separator = line.find(possible) != std::string::npos ? possible : separator;
    std::vector<std::string> cells = cells_of(line);
    while (cells.size() > names.size() && cells.back().empty())
      cells.pop_back();
    is_empty_last = std::all_of(cells.begin(), cells.end(),
                                [](const std::string &cell) { return cell.empty(); });
    if (is_empty_last)
      return;
    if (names.empty())
    {
      names = cells;
      for (const std::string &own : names)
        if (std::count(names.begin(), names.end(), own) > 1)
          throw EntryError(entry, "file '" + name + "' has two columns '" + own + "'");
      return;
    }
    rows.push_back({number, cells});
    if (cells.size() != names.size())
      fail(rows.size() - 1, std::to_string(cells.size()) + " cells for " +
                                std::to_string(names.size()) + " columns separated by " +
                                (separator == '\t' ? "tabs" : std::string("'") + separator + "'"));
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
    if (found != names.end())
      return found - names.begin();
    const std::string wanted = boost::algorithm::to_lower_copy(column);
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const auto [head, unit] = head_and_unit(names[i]);
      if (boost::algorithm::to_lower_copy(head) != wanted)
        continue;
      if (!unit.empty() && units_of_si.count(unit) == 0)
        throw EntryError(entry, "file '" + name + "': the numbers of column '" + names[i] +
                                    "' are in '" + unit +
                                    "'; give them in units of SI, and name these");
      return i;
    }
    return none;
  }

  std::vector<std::string> CsvTable::heads() const
  {
    std::vector<std::string> result;
    for (const std::string &own : names)
      result.push_back(boost::algorithm::to_lower_copy(head_and_unit(own).first));
    return result;
  }

  bool CsvTable::has(const std::string &column) const
  {
    return index(column) != none;
  }

  const std::string &CsvTable::text(const std::size_t row, const std::string &column) const
  {
    static const std::string nothing;
    const std::size_t i = index(column);
    return i == none || row >= rows.size() ? nothing : rows[row].cells[i];
  }

  double CsvTable::to_number(const std::size_t row, const std::string &column,
                             std::string text) const
  {
    if (separator != ',')
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
