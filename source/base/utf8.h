// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_utf8_h
#define taut_utf8_h

#include <boost/locale/utf.hpp>

#include <cstddef>
#include <string>

namespace taut
{
  /// Number of bytes of the UTF-8 character at text[i]; 0 if there is none.
  inline std::size_t utf8_length(const std::string &text, const std::size_t i)
  {
    auto at = text.begin() + static_cast<std::ptrdiff_t>(i);
    const auto code = boost::locale::utf::utf_traits<char>::decode(at, text.end());
    return boost::locale::utf::is_valid_codepoint(code)
               ? static_cast<std::size_t>(at - text.begin()) - i
               : 0;
  }

  /// Place of the first byte that is no UTF-8; the length of the text if there is none.
  inline std::size_t end_of_utf8(const std::string &text)
  {
    std::size_t i = 0;
    for (std::size_t n = 1; i < text.size() && n > 0; i += n)
      n = utf8_length(text, i);
    return i;
  }
} // namespace taut

#endif
