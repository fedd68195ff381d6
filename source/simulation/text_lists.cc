// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/simulation/text_lists.h>

#include <sstream>

namespace taut
{
  std::vector<std::string> split(const std::string &text, const char separator)
  {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);)
    {
      const std::size_t first = part.find_first_not_of(" \t"), last = part.find_last_not_of(" \t");
      parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
    }
    return parts;
  }
} // namespace taut
