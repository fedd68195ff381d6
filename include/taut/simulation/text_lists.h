// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_text_lists_h
#define taut_text_lists_h

#include <string>
#include <vector>

namespace taut
{
  /// Parts between separators, without spaces around them.
  std::vector<std::string> split(const std::string &text, char separator);
} // namespace taut

#endif
