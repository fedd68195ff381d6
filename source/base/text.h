// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_text_h
#define taut_text_h

#include <taut/base/coordinates.h>

#include <cctype>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

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

  /// Without spaces, tabs and carriage returns around it.
  inline std::string trim(const std::string &text)
  {
    const std::size_t first = text.find_first_not_of(" \t\r"),
                      last = text.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
  }

  /// With a capital letter at its beginning.
  inline std::string capitalised(std::string text)
  {
    if (!text.empty())
      text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
  }

  /// Parts between separators, without spaces around them.
  inline std::vector<std::string> split(const std::string &text, const char separator)
  {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);)
      parts.push_back(trim(part));
    return parts;
  }
} // namespace taut

#endif
