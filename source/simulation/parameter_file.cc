// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/file_text.h"

#include <taut/base/exceptions.h>
#include <taut/simulation/parameter_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace taut
{
  namespace
  {
    constexpr std::size_t deepest_include = 20, deepest_section = 20;

    std::string join(const std::vector<std::string> &path)
    {
      std::string text;
      for (const std::string &part : path)
        text += (text.empty() ? "" : "/") + part;
      return text;
    }

    /// Whether the file that an entry was read in was included by the one that is read now.
    bool is_included(const std::vector<std::string> &open_then,
                     const std::vector<std::string> &open_now)
    {
      return open_then.size() > open_now.size() &&
             std::equal(open_now.begin(), open_now.end(), open_then.begin());
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
    set_in.clear();
    index.clear();
    section_index.clear();
    if (std::filesystem::path(file).extension() == ".json")
      throw UserError(file + ": scenes are not read from JSON; take a .prm file, with "
                             "'subsection Name', 'set Name = value' and 'end'");
    std::vector<std::string> path;
    open_files.clear();
    read_prm(file, path);
    if (!path.empty())
      throw UserError(locate(join(path)) + ": the section is opened and never closed; add 'end'");
    if (list.empty())
      throw UserError(file +
                      ": it sets no entry; 'taut' without a file writes one with all entries");
  }

  void ParameterFile::add(Entry entry)
  {
    for (const std::string &part : entry.path)
      if (part.empty())
        throw UserError(entry.place + ": '" + entry.name() + "' = '" + entry.value +
                        "': the name of an entry or section is empty; write 'set Name = value'");
    for (const std::string &text : {entry.path.back(), entry.value})
      if (!text.empty() && text.back() == '\\')
        throw UserError(entry.place + ": " + entry.name() + " = '" + entry.value +
                        "': '\\' at the end continues a line, but there is none; remove it");
    const auto [known, is_new] = index.emplace(entry.name(), list.size());
    if (!is_new && !open_files.empty() && is_included(set_in[known->second], open_files))
    {
      set_in[known->second] = open_files;
      list[known->second] = std::move(entry);
      return;
    }
    if (!is_new)
      throw UserError(entry.place + ": '" + entry.name() + "' was set before, at " +
                      list[known->second].place +
                      "; remove one of them. Only an entry of an included file is set again, after "
                      "the include");
    list.push_back(std::move(entry));
    set_in.push_back(open_files);
  }

  void ParameterFile::add_section(const std::vector<std::string> &path, const std::string &place)
  {
    if (path.size() > deepest_section)
      throw UserError(place + ": more than " + std::to_string(deepest_section) +
                      " sections in each other; is an 'end' missing?");
    if (section_index.emplace(join(path), section_list.size()).second)
      section_list.push_back({path, "", place});
  }

  void ParameterFile::read_prm(const std::string &file, std::vector<std::string> &path)
  {
    open_files.push_back(std::filesystem::path(file).lexically_normal().string());
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
        std::error_code error;
        if (!std::filesystem::is_regular_file(included, error))
          throw UserError(place + ": cannot include '" + included.string() + "': no such file");
        if (open_files.size() > deepest_include ||
            std::count(open_files.begin(), open_files.end(), included.lexically_normal().string()) >
                0)
          throw UserError(place + ": cannot include '" + included.string() +
                          "': it is being read already and would include itself; remove one of "
                          "the includes");
        read_prm(included.string(), path);
      }
      else
        throw UserError(place + ": cannot read '" + line +
                        "'; a line is 'set Name = value', 'subsection Name', 'end', 'include file' "
                        "or a comment after '#'");
    }
    open_files.pop_back();
  }

  /// Parts between dots; names of sections of the file may have dots of their own.
  std::vector<std::string> ParameterFile::split_at_dots(const std::string &text) const
  {
    const std::vector<std::string> parts = split(text, '.');
    std::vector<std::string> path;
    for (std::size_t i = 0, next = 0; i < parts.size(); i = next)
    {
      next = i + 1;
      std::string name = parts[i], longer = name;
      for (std::size_t k = i + 1; k < parts.size(); ++k)
      {
        longer += "." + parts[k];
        std::vector<std::string> section = path;
        section.push_back(longer);
        if (section_index.count(join(section)) == 0)
          continue;
        name = longer;
        next = k + 1;
      }
      path.push_back(name);
    }
    return path;
  }

  const ParameterFile::Entry &ParameterFile::set(const std::string &assignment)
  {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UserError("--set '" + assignment + "': write Section.Entry=value");
    Entry entry{{}, trim(assignment.substr(equals + 1)), "--set"};
    const std::string path = assignment.substr(0, equals);
    entry.path = path.find('/') != std::string::npos ? split(path, '/') : split_at_dots(path);
    if (const auto origin = origins.find(entry.name()); origin != origins.end())
      entry.place = origin->second;
    if (entry.value.find_first_of("\n#") != std::string::npos)
      throw UserError("--set '" + assignment + "': a value has no line end and no '#'");
    check_text(assignment, "--set");
    const auto known = index.find(entry.name());
    if (known != index.end() && (entry.value.empty() || entry.value.back() != '\\'))
      return list[known->second] = entry;
    add(entry);
    return list.back();
  }

  std::string ParameterFile::place_of(const std::string &name) const
  {
    const auto known = index.find(name);
    return known == index.end() ? main_file : list[known->second].place;
  }

  void ParameterFile::broadcast(const Communicator &processes)
  {
    if (processes.size() == 1)
      return;
    const auto as_json = [](const std::vector<Entry> &items)
    {
      nlohmann::json all = nlohmann::json::array();
      for (const Entry &item : items)
        all.push_back({item.path, item.value, item.place});
      return all;
    };
    std::string text;
    if (processes.is_root())
      text = nlohmann::json({main_file, as_json(list), as_json(section_list)}).dump();
    processes.broadcast(text);
    if (processes.is_root())
      return;

    const nlohmann::json all = nlohmann::json::parse(text);
    main_file = all[0].get<std::string>();
    const auto take = [](const nlohmann::json &items, std::vector<Entry> &to,
                         std::map<std::string, std::size_t> &names)
    {
      to.clear();
      names.clear();
      for (const auto &item : items)
      {
        to.push_back({item[0].get<std::vector<std::string>>(), item[1].get<std::string>(),
                      item[2].get<std::string>()});
        names.emplace(join(to.back().path), to.size() - 1);
      }
    };
    take(all[1], list, index);
    take(all[2], section_list, section_index);
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
    // For a section or an unset entry: the innermost known entry or section around it.
    const std::string suffix = name.empty() ? "" : ": " + name;
    for (std::string path = name; !path.empty();)
    {
      const auto around = index.find(path);
      if (around != index.end())
        return list[around->second].place + ": " + path + " = '" +
               shortened(list[around->second].value) + "'";
      const auto section = section_index.find(path);
      if (section != section_index.end())
        return section_list[section->second].place + suffix;
      const std::size_t slash = path.rfind('/');
      path = slash == std::string::npos ? "" : path.substr(0, slash);
    }
    return main_file + suffix;
  }
} // namespace taut
