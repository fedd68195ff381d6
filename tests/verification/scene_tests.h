// SPDX-License-Identifier: LGPL-2.1-or-later
// What the tests of scenes need: runs of scenes, GoogleTest, errors of the user, and the headers of
// C++ that nearly all of them use.
#ifndef taut_verification_scene_tests_h
#define taut_verification_scene_tests_h

#include "run.h"

#include <taut/base/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
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

  inline bool has(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  /// What @p value finds at the start and after each step of a scene.
  template <typename Value>
  auto series(const std::string &file_or_text, const Overrides &overrides, const Value &value)
  {
    std::vector<decltype(value(std::declval<const taut::StepView &>()))> result;
    run_scene(file_or_text, overrides,
              [&](const taut::StepView &view) { result.push_back(value(view)); });
    return result;
  }

  /// The largest magnitude.
  inline double largest(const std::vector<double> &values)
  {
    double result = 0.;
    for (const double value : values)
      result = std::max(result, std::fabs(value));
    return result;
  }
} // namespace verification

#endif
