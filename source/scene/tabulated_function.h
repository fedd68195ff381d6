// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_tabulated_function_h
#define taut_tabulated_function_h

#include <atomic>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace taut
{
  enum class Interpolation
  {
    linear,
    cubic ///< monotone between the rows, with a continuous slope
  };

  /// A function between rows of a table. The search for an interval begins at that of the last
  /// call. An evaluation allocates nothing; any thread may evaluate.
  class TabulatedFunction
  {
  public:
    /// A place outside of the table.
    class Outside : public std::domain_error
    {
    public:
      using std::domain_error::domain_error;
    };

    /// A column of a CSV file over its first one. Throws EntryError on @p entry if the file cannot
    /// be read, has fewer than two rows (cubic: four), numbers that are not finite, or a first
    /// column that does not increase.
    TabulatedFunction(const std::string &file, const std::string &column, Interpolation kind,
                      const std::string &entry);

    /// The value at @p x, in units of the table. Throws Outside beyond the first or the last row.
    double operator()(double x) const
    {
      std::size_t i = hint.load(std::memory_order_relaxed);
      if (!(x >= rows[i].x && x < rows[i + 1].x))
        i = find(x);
      const Row &row = rows[i];
      const double d = x - row.x;
      return row.value + d * (row.slope + d * (row.second + d * row.third));
    }

    /// Digest of all rows and of the kind.
    const std::string &content() const { return own_content; }

  private:
    /// With the coefficients of a cubic up to the next row.
    struct Row
    {
      double x, value, slope = 0., second = 0., third = 0.;
    };

    void make_lines();
    void make_cubics();
    std::size_t find(double &x) const;

    const std::string file, column;
    std::vector<Row> rows;
    double tolerance = 0.; ///< by which x may miss an end, from rounding
    std::string own_content;
    mutable std::atomic<std::size_t> hint{0};
  };

  /// The function of a column, which all entries that name it share while the file is as it was
  /// read. Throws as TabulatedFunction does.
  std::shared_ptr<const TabulatedFunction> shared_table(const std::string &file,
                                                        const std::string &column,
                                                        Interpolation kind,
                                                        const std::string &entry);
} // namespace taut

#endif
