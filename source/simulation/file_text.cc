// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/file_text.h"

#include "base/nearest_name.h"
#include "base/utf8.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace taut
{
  void check_text(const std::string &text, const std::string &place)
  {
    for (std::size_t i = 0; i < text.size();)
    {
      const std::size_t n = utf8_length(text, i);
      const auto byte = static_cast<unsigned char>(text[i]);
      if (n == 0 || (byte < 0x20 && byte != '\t') || byte == 0x7f)
      {
        const char digits[] = "0123456789abcdef";
        throw UserError(place + ": this is not text: byte 0x" + digits[byte >> 4] +
                        digits[byte & 15] + "; a parameter file is text in UTF-8");
      }
      i += n;
    }
  }

  std::string cannot_read(const std::string &file, const int reason)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::is_directory(file, error))
      return "cannot read '" + file + "': it is a folder; name a file in it";
    if (fs::exists(file, error))
      return "cannot read '" + file + "': " + std::strerror(reason);
    // Parameter files beside it; an unreadable folder has none.
    const fs::path folder = fs::path(file).parent_path();
    std::vector<std::string> names;
    for (const auto &entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
      if (entry.path().extension() == ".prm")
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    const std::string near = nearest_name(fs::path(file).filename().string(), names);
    return "cannot read '" + file + "': no such file" +
           (near.empty() ? "" : "; did you mean '" + (folder / near).string() + "'?");
  }

  std::vector<std::pair<int, std::string>> lines_of(const std::string &file)
  {
    std::ifstream in(file, std::ios::binary);
    const int reason = errno;
    std::error_code error;
    if (!in || std::filesystem::is_directory(file, error))
      throw UserError(cannot_read(file, reason));
    std::vector<std::pair<int, std::string>> lines;
    std::string text;
    int number = 0, first = 0;
    bool continued = false;
    for (std::string line; std::getline(in, line);)
    {
      ++number;
      if (number == 1 && line.compare(0, 3, "\xef\xbb\xbf") == 0)
        line.erase(0, 3); // UTF-8 mark of some editors
      // Comments may be in any encoding, but a zero means another kind of file.
      if (line.find('\0') == std::string::npos)
        line = trim(line.substr(0, line.find('#')));
      check_text(line, file + ":" + std::to_string(number));
      if (!continued)
      {
        first = number;
        text.clear();
      }
      continued = !line.empty() && line.back() == '\\';
      if (continued)
        line = trim(line.substr(0, line.size() - 1)) + " ";
      text += line;
      if (!continued && !text.empty())
        lines.emplace_back(first, text);
    }
    if (continued)
      lines.emplace_back(first, text);
    if (in.bad())
      throw UserError("cannot read '" + file + "' to its end");
    return lines;
  }

  std::string shortened(const std::string &value)
  {
    constexpr std::size_t most = 80;
    if (value.size() <= most)
      return value;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(value[end]) & 0xc0) == 0x80)
      --end; // not within a character
    return value.substr(0, end) + "...";
  }
} // namespace taut
