// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/csv_file.h>
#include <taut/output/table_file.h>

namespace taut
{
  namespace
  {
    /// What tables keep in memory before they write [bytes].
    constexpr std::size_t largest_buffer = 1 << 16;
  } // namespace

  TableFile::TableFile(const std::string &path, const std::vector<std::string> &columns,
                       const bool goes_on)
      : path(path)
  {
    if (goes_on)
      return;
    file.create(path);
    for (std::size_t i = 0; i < columns.size(); ++i)
      buffer += (i == 0 ? "" : ",") + csv_cell(columns[i]);
    buffer += '\n';
  }

  void TableFile::end_line()
  {
    if (buffer.size() > largest_buffer)
      write();
  }

  /// What could not be written stays in the buffer, for another try.
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
