// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/table_file.h>

#include <charconv>
#include <cstring>

namespace taut
{
  namespace
  {
    /// Memory of a table before it is written [bytes].
    constexpr std::size_t largest_buffer = 1 << 16;
  } // namespace

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

  TableFile::TableFile(const std::string &path, const std::vector<std::string> &columns,
                       const bool goes_on, const TableFormat format)
      : path(path), format(format)
  {
    if (goes_on)
      return;
    file.create(path);
    for (std::size_t i = 0; i < columns.size(); ++i)
      buffer += (i == 0 ? "" : ",") + csv_cell(columns[i]);
    buffer += '\n';
  }

  TableFile::TableFile(const TableFormat format, const std::string &stem,
                       const std::vector<std::string> &columns, const bool goes_on)
      : TableFile(stem + (format == TableFormat::binary ? ".bin" : ".csv"), columns, goes_on,
                  format)
  {
  }

  TableFile::Number::Number(const double value) : value(value)
  {
    text[0] = ',';
    length = std::to_chars(text + 1, text + sizeof text, value).ptr - text;
  }

  TableFile &TableFile::operator<<(const double given)
  {
    const double value = given + 0.; // no -0
    if (format == TableFormat::binary)
    {
      add_bytes(&value, 1);
      return *this;
    }
    const auto is_same = [value](const Number &number)
    { return std::memcmp(&number.value, &value, sizeof value) == 0; };
    if (!is_same(last[0]) && !is_same(last[1]))
    {
      last[1] = last[0];
      last[0] = Number(value);
    }
    const Number &number = is_same(last[0]) ? last[0] : last[1];
    buffer.append(number.text + line_begins, number.length - line_begins);
    line_begins = false;
    return *this;
  }

  TableFile &TableFile::operator<<(const std::string &text)
  {
    buffer += (line_begins ? "" : ",") + csv_cell(text);
    line_begins = false;
    return *this;
  }

  TableFile &TableFile::begin_line(const double time)
  {
    if (format == TableFormat::binary)
      return *this << time;
    buffer += time_text(time);
    line_begins = false;
    return *this;
  }

  void TableFile::end_line()
  {
    if (format == TableFormat::csv)
      buffer += '\n';
    line_begins = true;
    if (buffer.size() > largest_buffer)
      write();
  }

  void TableFile::add_line(const double time, const std::vector<double> &values)
  {
    begin_line(time);
    if (format == TableFormat::binary)
      add_bytes(values.data(), values.size());
    else
      for (const double value : values)
        *this << value;
    end_line();
  }

  void TableFile::add_bytes(const double *const values, const std::size_t n)
  {
    buffer.append(reinterpret_cast<const char *>(values), n * sizeof(double));
  }

  /// Data that cannot be written stay in the buffer for the next attempt.
  void TableFile::write()
  {
    file.append(buffer);
    buffer.clear();
  }

  std::size_t TableFile::save()
  {
    write();
    file.sync();
    return file.length();
  }

  void TableFile::resume(const std::size_t length)
  {
    file.resume(path, length);
  }

  void TableFile::close()
  {
    write();
    file.close();
  }
} // namespace taut
