// SPDX-License-Identifier: LGPL-2.1-or-later
// What nearly all tests need: GoogleTest, some headers of C++, errors of the user and comparisons.
#ifndef taut_tests_common_h
#define taut_tests_common_h

#include <taut/base/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <unistd.h>

namespace verification
{
  namespace fs = std::filesystem;

  constexpr double pi = 3.14159265358979323846,
                   g = 9.81; ///< acceleration of gravity [m/s^2]

  /// The message of the error of the user that some work ends with; empty: none.
  inline std::string error_of(const std::function<void()> &work)
  {
    try
    {
      work();
    }
    catch (const taut::UserError &e)
    {
      return e.what();
    }
    return "";
  }

  /// Whether a text has a part, at @p from or behind it.
  inline bool has(const std::string &text, const std::string &part, const std::size_t from = 0)
  {
    return text.find(part, from) != std::string::npos;
  }

  /// All that a file says.
  inline std::string file_text(const std::string &path)
  {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// A new folder for files of a test, which is removed again with all that it has.
  class Folder
  {
  public:
    Folder()
    {
      std::string pattern = (fs::temp_directory_path() / "taut_test_XXXXXX").string();
      path = mkdtemp(pattern.data());
    }
    Folder(const Folder &) = delete;
    ~Folder()
    {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }

    std::string operator/(const std::string &name) const { return (path / name).string(); }

    /// Writes a file there; returns its path.
    std::string write(const std::string &name, const std::string &text) const
    {
      fs::create_directories((path / name).parent_path());
      std::ofstream(path / name, std::ios::binary) << text;
      return (path / name).string();
    }

    fs::path path;
  };

  inline std::vector<std::string> cells_of(const std::string &line)
  {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');)
      cells.push_back(cell);
    return cells;
  }

  /// The columns of a table of text by their titles, with NaN for what is no number.
  inline std::map<std::string, std::vector<double>> read_table(const std::string &path)
  {
    std::ifstream in(path);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> head = cells_of(line);
    std::map<std::string, std::vector<double>> table;
    while (std::getline(in, line))
    {
      const std::vector<std::string> cells = cells_of(line + ','); // the last one may be empty
      EXPECT_EQ(cells.size(), head.size()) << line;
      for (std::size_t i = 0; i < std::min(head.size(), cells.size()); ++i)
      {
        char *end = nullptr;
        const double value = std::strtod(cells[i].c_str(), &end);
        table[head[i]].push_back(end != cells[i].c_str() && *end == '\0' ? value : NAN);
      }
    }
    return table;
  }

  /// The largest magnitude.
  inline double largest(const std::vector<double> &values)
  {
    double result = 0.;
    for (const double value : values)
      result = std::max(result, std::fabs(value));
    return result;
  }

  /// Largest difference of numbers that are equally many.
  inline double largest_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    EXPECT_EQ(a.size(), b.size());
    double result = 0.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      result = std::isnan(b[i]) ? INFINITY : std::max(result, std::fabs(a[i] - b[i]));
    return result;
  }

  /// Where a property of @p low ends on the way to @p high, by bisection.
  inline double end_of(double low, double high, const std::function<bool(double)> &is_so)
  {
    for (int k = 0; k < 200; ++k)
      (is_so(.5 * (low + high)) ? low : high) = .5 * (low + high);
    return low;
  }

  /// A x.
  template <typename Matrix>
  std::vector<double> matrix_times(const Matrix &A, const std::vector<double> &x)
  {
    std::vector<double> result(x.size(), 0.);
    A.vmult_add(1., x.data(), result.data());
    return result;
  }
} // namespace verification

#endif
