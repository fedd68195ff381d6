// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_verification_error_of_h
#define taut_verification_error_of_h

#include <taut/base/exceptions.h>

#include <cstddef>
#include <functional>
#include <string>

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
} // namespace verification

#endif
