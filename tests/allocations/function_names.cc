// SPDX-License-Identifier: LGPL-2.1-or-later
#include "function_names.h"

#include <dlfcn.h>

#include <cstdint>
#include <cstdio>
#include <set>
#include <sstream>
#include <utility>

namespace allocations
{
  namespace
  {
    /// Lines that a command prints.
    std::vector<std::string> lines_of(const std::string &command)
    {
      std::vector<std::string> lines;
      FILE *const pipe = popen(command.c_str(), "r");
      if (pipe == nullptr)
        return lines;
      std::string line;
      for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
        if (c == '\n')
          lines.push_back(std::exchange(line, ""));
        else
          line += static_cast<char>(c);
      pclose(pipe);
      return lines;
    }

    /// The name without template arguments, parameters and type of the result.
    std::string short_name(std::string name)
    {
      name = name.substr(0, name.find(" [clone")); // of the compiler
      std::string text;
      int depth = 0;
      for (std::size_t i = 0; i < name.size(); ++i)
      {
        const bool is_bracket =
            text.size() < 8 || text.compare(text.size() - 8, 8, "operator") != 0;
        if (is_bracket && (name[i] == '<' || name[i] == '(' || name[i] == '{'))
          ++depth;
        else if (is_bracket && (name[i] == '>' || name[i] == ')' || name[i] == '}'))
          --depth;
        else if (depth == 0)
          text += name[i];
      }
      const std::string constant = " const";
      if (text.size() > constant.size() &&
          text.compare(text.size() - constant.size(), constant.size(), constant) == 0)
        text.erase(text.size() - constant.size());
      for (std::size_t at; (at = text.find("::::")) != std::string::npos;)
        text.erase(at, 2); // of an anonymous namespace
      return text.substr(text.rfind(' ') + 1);
    }
  } // namespace

  std::map<void *, std::string> function_names(const std::vector<void *> &addresses)
  {
    std::map<std::string, std::map<void *, std::uintptr_t>> files;
    for (void *address : std::set<void *>(addresses.begin(), addresses.end()))
    {
      Dl_info info;
      if (dladdr(address, &info) == 0 || info.dli_fname == nullptr ||
          std::string(info.dli_fname).find("taut") == std::string::npos)
        continue;
      // The call is before the address to which it returns.
      files[info.dli_fname][address] = reinterpret_cast<std::uintptr_t>(address) -
                                       reinterpret_cast<std::uintptr_t>(info.dli_fbase) - 1;
    }
    std::map<void *, std::string> names;
    for (const auto &[file, offsets] : files)
    {
      std::ostringstream command;
      command << "addr2line -f -C -e '" << file << "'" << std::hex;
      for (const auto &[address, offset] : offsets)
        command << " 0x" << offset;
      const std::vector<std::string> lines = lines_of(command.str());
      std::size_t i = 0;
      for (const auto &[address, offset] : offsets)
      {
        if (i < lines.size())
          names[address] = short_name(lines[i]);
        i += 2; // a line for the function and one for its place
      }
    }
    return names;
  }
} // namespace allocations
