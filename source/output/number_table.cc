// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/csv_file.h>
#include <taut/output/number_table.h>

namespace taut
{
  namespace
  {
    class TextTable : public NumberTable
    {
    public:
      TextTable(const std::string &path, const std::vector<std::string> &columns,
                const bool goes_on)
          : file(path, columns, goes_on)
      {
      }

      void add_line(const double time, const std::vector<double> &values) override
      {
        file.begin_line(time);
        for (const double value : values)
          file << value;
        file.end_line();
      }
      std::size_t save() override { return file.save(); }
      void resume(const std::size_t length) override { file.resume(length); }
      void close() override { file.close(); }

    private:
      CsvFile file;
    };

    class BinaryTable : public NumberTable
    {
    public:
      BinaryTable(const std::string &path, const std::vector<std::string> &columns,
                  const bool goes_on)
          : path(path)
      {
        if (goes_on)
          return;
        file.create(path);
        for (const std::string &column : columns)
          buffer += (buffer.empty() ? "" : ",") + csv_cell(column);
        buffer += '\n';
      }

      void add_line(const double time, const std::vector<double> &values) override
      {
        add(&time, 1);
        add(values.data(), values.size());
        if (buffer.size() > table_buffer)
          write();
      }

      std::size_t save() override
      {
        write();
        file.sync();
        return file.length();
      }
      void resume(const std::size_t length) override { file.resume(path, length); }

      void close() override
      {
        write();
        file.close();
      }

    private:
      void add(const double *values, const std::size_t n)
      {
        buffer.append(reinterpret_cast<const char *>(values), n * sizeof(double));
      }

      /// What could not be written stays in the buffer, for another try.
      void write()
      {
        file.append(buffer);
        buffer.clear();
      }

      std::string path;
      GrowingFile file;
      std::string buffer;
    };
  } // namespace

  std::unique_ptr<NumberTable> make_number_table(const TableFormat format, const std::string &stem,
                                                 const std::vector<std::string> &columns,
                                                 const bool goes_on)
  {
    if (format == TableFormat::binary)
      return std::make_unique<BinaryTable>(stem + ".bin", columns, goes_on);
    return std::make_unique<TextTable>(stem + ".csv", columns, goes_on);
  }
} // namespace taut
