// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_file_text_h
#define taut_file_text_h

#include "base/text.h"

#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /// Names and values go into messages, tables and JSON: throws UserError that begins with
  /// @p place unless @p text is UTF-8 without control characters.
  void check_text(const std::string &text, const std::string &place);

  /// Why a file cannot be read (@p reason is errno), with the nearest name if there is no such
  /// file.
  std::string cannot_read(const std::string &file, int reason);

  /// Lines of a file without comments, continued lines joined, each with the number of its first
  /// line. Throws UserError if it cannot be read or is not text.
  std::vector<std::pair<int, std::string>> lines_of(const std::string &file);

  /// A value for a message: its beginning, if it is long.
  std::string shortened(const std::string &value);
} // namespace taut

#endif
