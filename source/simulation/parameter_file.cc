// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/simulation/parameter_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace taut
{
  namespace
  {
    constexpr int deepest_include = 20;

    std::string trim(const std::string &text)
    {
      const std::size_t first = text.find_first_not_of(" \t\r"),
                        last = text.find_last_not_of(" \t\r");
      return first == std::string::npos ? "" : text.substr(first, last - first + 1);
    }

    std::string join(const std::vector<std::string> &path)
    {
      std::string text;
      for (const std::string &part : path)
        text += (text.empty() ? "" : "/") + part;
      return text;
    }

    /// The lines of a file without comments, continued ones joined, each with the number of its
    /// first.
    std::vector<std::pair<int, std::string>> lines_of(const std::string &file)
    {
      std::ifstream in(file, std::ios::binary);
      if (!in || std::filesystem::is_directory(file))
        throw UserError("cannot read '" + file + "': no such file, or no permission");
      std::vector<std::pair<int, std::string>> lines;
      std::string text;
      int number = 0, first = 0;
      bool continued = false;
      for (std::string line; std::getline(in, line);)
      {
        ++number;
        if (line.find('\0') != std::string::npos)
          throw UserError(file + ":" + std::to_string(number) +
                          ": this is not text; a parameter file is a text file");
        line = trim(line.substr(0, line.find('#')));
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
  } // namespace

  std::string ParameterFile::Entry::name() const
  {
    return join(path);
  }

  void ParameterFile::read(const std::string &file)
  {
    main_file = file;
    list.clear();
    section_list.clear();
    index.clear();
    section_index.clear();
    if (std::filesystem::path(file).extension() == ".json")
      read_json(file);
    else
    {
      std::vector<std::string> path;
      read_prm(file, path, 0);
      if (!path.empty())
        throw UserError(locate(join(path)) + ": the section is opened and never closed; add 'end'");
    }
  }

  void ParameterFile::add(Entry entry)
  {
    const auto [known, is_new] = index.emplace(entry.name(), list.size());
    if (!is_new)
      throw UserError(entry.place + ": '" + entry.name() + "' was set before, at " +
                      list[known->second].place + "; remove one of them");
    list.push_back(std::move(entry));
  }

  void ParameterFile::add_section(const std::vector<std::string> &path, const std::string &place)
  {
    if (section_index.emplace(join(path), section_list.size()).second)
      section_list.push_back({path, "", place});
  }

  void ParameterFile::read_prm(const std::string &file, std::vector<std::string> &path,
                               const int depth)
  {
    if (depth > deepest_include)
      throw UserError("'" + file + "' is included by itself");
    for (const auto &[number, line] : lines_of(file))
    {
      const std::string place = file + ":" + std::to_string(number);
      const std::size_t space = line.find_first_of(" \t");
      const std::string word = line.substr(0, space),
                        rest = space == std::string::npos ? "" : trim(line.substr(space));
      if ((word == "subsection" || word == "SUBSECTION") && !rest.empty())
      {
        path.push_back(rest);
        add_section(path, place);
      }
      else if ((word == "end" || word == "END") && rest.empty())
      {
        if (path.empty())
          throw UserError(place + ": 'end' without a 'subsection' to close");
        path.pop_back();
      }
      else if ((word == "set" || word == "SET") && rest.find('=') != std::string::npos)
      {
        const std::size_t equals = rest.find('=');
        Entry entry{path, trim(rest.substr(equals + 1)), place};
        entry.path.push_back(trim(rest.substr(0, equals)));
        add(std::move(entry));
      }
      else if ((word == "include" || word == "INCLUDE") && !rest.empty())
      {
        const auto included = std::filesystem::path(file).parent_path() / rest;
        if (!std::filesystem::exists(included))
          throw UserError(place + ": cannot include '" + included.string() + "': no such file");
        read_prm(included.string(), path, depth + 1);
      }
      else
        throw UserError(place + ": cannot read '" + line +
                        "'; a line is 'set Name = value', 'subsection Name', 'end', 'include file' "
                        "or a comment after '#'");
    }
  }

  void ParameterFile::read_json(const std::string &file)
  {
    using nlohmann::json;
    std::ifstream in(file);
    if (!in)
      throw UserError("cannot read '" + file + "': no such file, or no permission");

    // Keys of the objects that are open while parsing, to find one that comes twice.
    std::vector<std::vector<std::string>> open;
    const auto watch = [&](int, json::parse_event_t event, json &parsed)
    {
      if (event == json::parse_event_t::object_start)
        open.emplace_back();
      else if (event == json::parse_event_t::object_end)
        open.pop_back();
      else if (event == json::parse_event_t::key)
      {
        const std::string key = parsed.get<std::string>();
        if (std::count(open.back().begin(), open.back().end(), key) > 0)
          throw UserError(file + ": the name '" + key + "' comes twice in one object");
        open.back().push_back(key);
      }
      return true;
    };
    json root;
    try
    {
      root = json::parse(in, watch);
    }
    catch (const json::exception &e)
    {
      throw UserError(file + ": this is not JSON: " + e.what());
    }
    if (!root.is_object())
      throw UserError(file + ": the whole file is one JSON object, {\"Name\": value, ...}");

    const auto text = [&](const json &value, const std::string &name)
    {
      if (value.is_string())
        return value.get<std::string>();
      if (value.is_number() || value.is_boolean())
        return value.dump();
      throw UserError(file + ": " + name +
                      ": a value is a text, a number, true, false or a list of these");
    };
    std::vector<std::string> path;
    const std::function<void(const json &)> walk = [&](const json &object)
    {
      for (const auto &[key, value] : object.items())
      {
        path.push_back(key);
        const std::string name = join(path);
        if (value.is_object())
        {
          add_section(path, file);
          walk(value);
        }
        else
        {
          std::string all;
          if (value.is_array())
            for (const json &item : value)
              all += (all.empty() ? "" : ", ") + text(item, name);
          else
            all = text(value, name);
          if (all.find_first_of("\n#") != std::string::npos ||
              name.find_first_of("\n#=") != std::string::npos)
            throw UserError(file + ": " + name + ": a name or value has no line end and no '#'");
          add({path, trim(all), file});
        }
        path.pop_back();
      }
    };
    walk(root);
  }

  void ParameterFile::set(const std::string &assignment)
  {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UserError("--set '" + assignment + "': write Section.Entry=value");
    Entry entry{{}, trim(assignment.substr(equals + 1)), "--set"};
    const std::string path = assignment.substr(0, equals);
    const char separator = path.find('/') != std::string::npos ? '/' : '.';
    std::istringstream parts(path);
    for (std::string part; std::getline(parts, part, separator);)
      entry.path.push_back(trim(part));
    if (entry.value.find_first_of("\n#") != std::string::npos)
      throw UserError("--set '" + assignment + "': a value has no line end and no '#'");
    const auto known = index.find(entry.name());
    if (known != index.end())
      list[known->second] = entry;
    else
      add(entry);
  }

  std::string ParameterFile::text() const
  {
    std::string result;
    const auto write = [&](const std::vector<std::string> &path, const std::size_t n_sections,
                           const std::string &line)
    {
      for (std::size_t i = 0; i < n_sections; ++i)
        result += "subsection " + path[i] + "\n";
      result += line;
      for (std::size_t i = 0; i < n_sections; ++i)
        result += "end\n";
    };
    for (const Entry &entry : list)
      write(entry.path, entry.path.size() - 1,
            "set " + entry.path.back() + " = " + entry.value + "\n");
    return result;
  }

  std::string ParameterFile::locate(const std::string &name) const
  {
    const auto entry = index.find(name);
    if (entry != index.end())
      return list[entry->second].place + ": " + name + " = '" + list[entry->second].value + "'";
    // Not set, or a section: the innermost section around it that is there.
    const std::string suffix = name.empty() ? "" : ": " + name;
    for (std::string path = name; !path.empty();)
    {
      const auto section = section_index.find(path);
      if (section != section_index.end())
        return section_list[section->second].place + suffix;
      const std::size_t slash = path.rfind('/');
      path = slash == std::string::npos ? "" : path.substr(0, slash);
    }
    return main_file + suffix;
  }
} // namespace taut
