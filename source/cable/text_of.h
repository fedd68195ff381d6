// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cable_text_of_h
#define taut_cable_text_of_h

#include <sstream>
#include <string>

namespace taut
{
  /// A number as messages show it.
  inline std::string text_of(const double value)
  {
    std::ostringstream text;
    text << value;
    return text.str();
  }
} // namespace taut

#endif
