// SPDX-License-Identifier: LGPL-2.1-or-later
// What nearly all tests need: GoogleTest, some headers of C++, errors of the user and comparisons.
#ifndef taut_tests_common_h
#define taut_tests_common_h

#include <taut/base/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace verification
{
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
} // namespace verification

#endif
