// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_text_h
#define taut_text_h

#include <taut/base/coordinates.h>

#include <iomanip>
#include <sstream>
#include <string>

namespace taut
{
  /// "x, y, z"
  inline std::ostream &operator<<(std::ostream &out, const Coordinates &p)
  {
    return out << p.x << ", " << p.y << ", " << p.z;
  }

  /// The parts one after the other, as a stream writes them: numbers with six digits unless
  /// std::setprecision comes before them.
  template <typename... Parts>
  std::string to_text(const Parts &...parts)
  {
    std::ostringstream out;
    (out << ... << parts);
    return out.str();
  }
} // namespace taut

#endif
