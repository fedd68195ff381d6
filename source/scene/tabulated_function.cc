// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/tabulated_function.h"

#include "base/csv_table.h"
#include "base/data_files.h"
#include "base/text.h"
#include <taut/base/exceptions.h>

#include <math.h> // isnan, which pchip.hpp of Boost 1.74 takes from the global namespace

#include <boost/math/interpolators/pchip.hpp>

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

namespace taut
{
  TabulatedFunction::TabulatedFunction(const std::string &file, const std::string &column,
                                       const Interpolation kind, const std::string &entry)
      : file(file), column(column)
  {
    const CsvTable table(file, entry);
    const std::string &first = table.columns().front();
    const std::vector<double> values = table.numbers(column);
    for (std::size_t i = 0; i < table.n_rows(); ++i)
    {
      rows.push_back({table.number(i, first), values[i]});
      if (i > 0 && !(rows[i].x > rows[i - 1].x))
        table.fail(i, to_text("'", first, "' is ", rows[i].x, " after ", rows[i - 1].x,
                              "; sort the rows by their first column, which has each value once"));
    }
    const std::size_t least = kind == Interpolation::cubic ? 4 : 2;
    if (rows.size() < least)
      throw EntryError(
          entry, to_text("file '", file, "' has ", rows.size(), rows.size() == 1 ? " row" : " rows",
                         "; ", kind == Interpolation::cubic ? "cubic interpolation" : "a table",
                         " takes ", least, " and more"));
    constexpr double rounding = 1e-9;
    tolerance = rounding * (rows.back().x - rows.front().x);
    kind == Interpolation::cubic ? make_cubics() : make_lines();
    own_content =
        digest(std::string(reinterpret_cast<const char *>(rows.data()), rows.size() * sizeof(Row)));
  }

  void TabulatedFunction::make_lines()
  {
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
      rows[i].slope = (rows[i + 1].value - rows[i].value) / (rows[i + 1].x - rows[i].x);
  }

  void TabulatedFunction::make_cubics()
  {
    std::vector<double> x, value;
    for (const Row &row : rows)
    {
      x.push_back(row.x);
      value.push_back(row.value);
    }
    const boost::math::interpolators::pchip<std::vector<double>> curve(std::move(x),
                                                                       std::move(value));
    for (Row &row : rows)
      row.slope = curve.prime(row.x);
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    {
      Row &a = rows[i];
      const Row &b = rows[i + 1];
      const double h = b.x - a.x, mean = (b.value - a.value) / h;
      a.second = (3. * mean - 2. * a.slope - b.slope) / h;
      a.third = (a.slope + b.slope - 2. * mean) / (h * h);
    }
  }

  /// Moves @p x onto an end that it misses by rounding.
  std::size_t TabulatedFunction::find(double &x) const
  {
    const double first = rows.front().x, last = rows.back().x;
    if (!(x >= first - tolerance && x <= last + tolerance))
      throw Outside(to_text(std::setprecision(15), "file '", file, "' has '", column, "' from ",
                            first, " to ", last, " and none at ", x,
                            "; the rows have to cover what is used"));
    x = std::clamp(x, first, last);
    // Rows at equal distances lead from the last interval to that of x, or next to it.
    const std::size_t before = hint.load(std::memory_order_relaxed), n = rows.size() - 1;
    const double intervals = (x - rows[before].x) / (rows[before + 1].x - rows[before].x),
                 guess = static_cast<double>(before) + intervals;
    std::size_t i =
        guess > 0. ? static_cast<std::size_t>(std::min(guess, static_cast<double>(n - 1))) : 0;
    if (x < rows[i].x && i > 0)
      --i;
    else if (x >= rows[i + 1].x && i + 1 < n)
      ++i;
    if (!(x >= rows[i].x && (x < rows[i + 1].x || i + 1 == n)))
    {
      const auto next = std::upper_bound(
          rows.begin(), rows.end(), x, [](const double at, const Row &row) { return at < row.x; });
      i = std::min<std::size_t>(next - rows.begin(), n) - 1;
    }
    hint.store(i, std::memory_order_relaxed);
    return i;
  }

  std::shared_ptr<const TabulatedFunction> shared_table(const std::string &file,
                                                        const std::string &column,
                                                        const Interpolation kind,
                                                        const std::string &entry)
  {
    using Key = std::tuple<std::string, std::string, Interpolation>;
    struct Known
    {
      std::shared_ptr<const std::string> text;
      std::shared_ptr<const TabulatedFunction> table;
    };
    static std::mutex mutex;
    static std::map<Key, Known> all;
    const std::lock_guard<std::mutex> lock(mutex);
    const std::shared_ptr<const std::string> text = read_data_file(file, entry);
    Known &known = all[{file, column, kind}];
    if (known.text != text)
    {
      known.table.reset();
      known.table = std::make_shared<TabulatedFunction>(file, column, kind, entry);
      known.text = text;
    }
    return known.table;
  }
} // namespace taut
