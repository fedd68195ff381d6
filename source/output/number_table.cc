// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/csv_file.h>
#include <taut/output/number_table.h>

namespace taut
{
  namespace
  {
    template <typename File>
    class TableIn : public NumberTable
    {
    public:
      TableIn(const std::string &path, const std::vector<std::string> &columns, const bool goes_on)
          : file(path, columns, goes_on)
      {
      }
      std::size_t save() override { return file.save(); }
      void resume(const std::size_t length) override { file.resume(length); }
      void close() override { file.close(); }

    protected:
      File file;
    };

    class TextTable : public TableIn<CsvFile>
    {
    public:
      using TableIn::TableIn;
      void add_line(const double time, const std::vector<double> &values) override
      {
        file.begin_line(time);
        for (const double value : values)
          file << value;
        file.end_line();
      }
    };

    class BinaryTable : public TableIn<TableFile>
    {
    public:
      using TableIn::TableIn;
      void add_line(const double time, const std::vector<double> &values) override
      {
        add(&time, 1);
        add(values.data(), values.size());
        file.end_line();
      }

    private:
      void add(const double *values, const std::size_t n)
      {
        file.add(reinterpret_cast<const char *>(values), n * sizeof(double));
      }
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
