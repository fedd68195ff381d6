// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_verification_scene_builder_h
#define taut_verification_scene_builder_h

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace verification
{
  /**
   * A scene that says each thing in one line: "Link stop: From = ground; To = beam @ 2; Gap = 0.1".
   * Wires, supports, masses, springs, links and loads go to the section Network, and their names to
   * the lists there; the generator is then 'network'. Pantographs, probes, bodies, contacts,
   * parameters and quantities of a study find their sections and lists, too. Other sections have
   * their path, as in "Time/Newmark: Beta = 0.25", and entries of no section "Start = equilibrium".
   *
   * A line that begins with a space continues the one before, one that begins with # says nothing.
   * Later lines change what earlier ones said: "Link stop: -Gap" takes an entry out, "Link stop: -"
   * the section. "*Gap = 1" and "Link stop: *" end their line of the text with the mark " # here".
   */
  class SceneBuilder
  {
  public:
    explicit SceneBuilder(const std::string &lines = "") { add(lines); }

    SceneBuilder &add(std::string lines)
    {
      for (std::size_t at; (at = lines.find("\n ")) != std::string::npos;)
        lines.erase(at, 1);
      for (const std::string &line : split(lines, "\n"))
        if (!line.empty() && line[0] != '#')
          add_line(line);
      return *this;
    }

    /// The text of the .prm file.
    std::string text() const { return text(root, ""); }

  private:
    using Entry = std::pair<std::string, std::string>;

    struct Section
    {
      std::string name, mark = "";
      std::vector<Entry> entries = {};
      std::vector<Section> sections = {};
    };

    /// Sections that a list names, and the section that both are in.
    struct Kind
    {
      std::string name, list, home;
    };

    static const Kind *kind_of(const std::string &section)
    {
      static const std::vector<Kind> kinds = {{"Wire ", "Wires", "Network"},
                                              {"Support ", "Supports", "Network"},
                                              {"Mass ", "Masses", "Network"},
                                              {"Point mass ", "Point masses", "Network"},
                                              {"Spring ", "Springs", "Network"},
                                              {"Link ", "Links", "Network"},
                                              {"Load ", "Loads", "Network"},
                                              {"Pantograph ", "Pantographs", "Catenary"},
                                              {"Body ", "Bodies", ""},
                                              {"Contact ", "Contacts", ""},
                                              {"Probe ", "Probes", "Output"},
                                              {"Parameter ", "Parameters", "Study"},
                                              {"Quantity ", "Quantities", "Study"}};
      const auto found =
          std::find_if(kinds.begin(), kinds.end(),
                       [&](const Kind &kind) { return section.rfind(kind.name, 0) == 0; });
      return found == kinds.end() ? nullptr : &*found;
    }

    static std::string trimmed(const std::string &text)
    {
      const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
      return begin == std::string::npos ? "" : text.substr(begin, end + 1 - begin);
    }

    static std::vector<std::string> split(const std::string &text, const std::string &separator)
    {
      std::vector<std::string> parts;
      std::size_t begin = 0;
      for (std::size_t at; (at = text.find(separator, begin)) != std::string::npos;
           begin = at + separator.size())
        parts.push_back(trimmed(text.substr(begin, at - begin)));
      parts.push_back(trimmed(text.substr(begin)));
      return parts;
    }

    static auto find(std::vector<Section> &sections, const std::string &name)
    {
      return std::find_if(sections.begin(), sections.end(),
                          [&](const Section &section) { return section.name == name; });
    }

    static auto find(std::vector<Entry> &entries, const std::string &name)
    {
      return std::find_if(entries.begin(), entries.end(),
                          [&](const Entry &entry) { return entry.first == name; });
    }

    static std::string &set(Section &section, const std::string &name, const std::string &value)
    {
      const auto found = find(section.entries, name);
      if (found == section.entries.end())
        return section.entries.emplace_back(name, value).second;
      return found->second = value;
    }

    /// The section that one holds, which is new and in the list of its kind if it is missing.
    static Section &inner(Section &outer, const std::string &name)
    {
      const auto found = find(outer.sections, name);
      if (found != outer.sections.end())
        return *found;
      const Kind *kind = kind_of(name);
      if (kind && kind->home == outer.name)
      {
        const std::string own = name.substr(kind->name.size());
        const auto list = find(outer.entries, kind->list);
        if (list == outer.entries.end())
          outer.entries.emplace_back(kind->list, own);
        else if (const auto names = split(list->second, ",");
                 std::find(names.begin(), names.end(), own) == names.end())
          list->second += ", " + own;
      }
      outer.sections.push_back({name});
      return outer.sections.back();
    }

    void add_line(const std::string &line)
    {
      const std::size_t equals = line.find('='), colon = line.find(':');
      if (colon >= equals)
        return add_entries(root, line);
      std::vector<std::string> path = split(line.substr(0, colon), "/");
      if (const Kind *kind = kind_of(path[0]); kind && !kind->home.empty())
        path.insert(path.begin(), kind->home);
      if (path[0] == "Network" && find(root.entries, "Generator") == root.entries.end())
        set(root, "Generator", "network");
      Section *outer = nullptr, *section = &root;
      for (const std::string &name : path)
        section = &inner(*(outer = section), name);
      const std::string rest = trimmed(line.substr(colon + 1));
      if (rest == "-")
        outer->sections.erase(find(outer->sections, path.back()));
      else
        add_entries(*section, rest);
    }

    /// Does "name = value; *name = value; -name; *" to a section.
    static void add_entries(Section &section, const std::string &entries)
    {
      std::string *last = nullptr;
      for (std::string entry : split(entries, "; "))
      {
        if (!entry.empty() && entry.back() == ';')
          entry.pop_back();
        if (entry.empty())
          continue;
        const std::size_t equals = entry.find('=');
        const bool is_marked = entry[0] == '*';
        if (entry == "*")
          section.mark = " # here";
        else if (equals != std::string::npos)
          last = &set(section, trimmed(entry.substr(is_marked, equals - is_marked)),
                      trimmed(entry.substr(equals + 1)) + (is_marked ? " # here" : ""));
        else if (const auto found = find(section.entries, trimmed(entry.substr(1)));
                 entry[0] == '-' && found != section.entries.end())
          section.entries.erase(found);
        else if (last)
          *last += "; " + entry; // a value with semicolons
        else
          throw std::invalid_argument("no scene says '" + entry + "'");
      }
    }

    static std::string text(const Section &section, const std::string &indent)
    {
      std::string result;
      for (const auto &[name, value] : section.entries)
        result += indent + "set " + name + " = " + value + "\n";
      for (const Section &inner : section.sections)
        result += indent + "subsection " + inner.name + inner.mark + "\n" +
                  text(inner, indent + "  ") + indent + "end\n";
      return result;
    }

    Section root = {};
  };

  /// The text of the .prm file of a scene in lines, or a text that is one already.
  inline std::string prm(const std::string &text)
  {
    static const std::regex begin_of_line("(^|\n) *(set|subsection|include) ");
    return std::regex_search(text, begin_of_line) ? text : SceneBuilder(text).text();
  }
} // namespace verification

#endif
