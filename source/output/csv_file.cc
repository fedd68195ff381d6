// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/csv_file.h>

#include <charconv>
#include <cstring>

namespace taut
{
  std::string csv_cell(const std::string &text)
  {
    if (text.find_first_of(",\"\n") == std::string::npos)
      return text;
    std::string result = "\"";
    for (const char c : text)
      result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
  }

  std::string csv_number(const double value)
  {
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }

  std::string time_text(const double time)
  {
    constexpr int n_digits = 14;
    char digits[32];
    const auto result =
        std::to_chars(digits, digits + sizeof digits, time, std::chars_format::general, n_digits);
    return std::string(digits, result.ptr);
  }

  CsvFile::CsvFile(const std::string &path, const std::vector<std::string> &columns,
                   const bool goes_on)
      : table(path, columns, goes_on)
  {
  }

  CsvFile::Number::Number(const double value) : value(value)
  {
    text[0] = ',';
    length = std::to_chars(text + 1, text + sizeof text, value).ptr - text;
  }

  CsvFile &CsvFile::operator<<(const double value)
  {
    const auto is_same = [value](const Number &number)
    { return std::memcmp(&number.value, &value, sizeof value) == 0; };
    if (!is_same(last[0]) && !is_same(last[1]))
    {
      last[1] = last[0];
      last[0] = Number(value);
    }
    const Number &number = is_same(last[0]) ? last[0] : last[1];
    table.add(number.text + line_begins, number.length - line_begins);
    line_begins = false;
    return *this;
  }

  CsvFile &CsvFile::operator<<(const std::string &text)
  {
    table.add((line_begins ? "" : ",") + csv_cell(text));
    line_begins = false;
    return *this;
  }

  CsvFile &CsvFile::begin_line(const double time)
  {
    table.add(time_text(time));
    line_begins = false;
    return *this;
  }

  void CsvFile::end_line()
  {
    table.add("\n", 1);
    line_begins = true;
    table.end_line();
  }
} // namespace taut
