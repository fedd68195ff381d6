// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/entry_check.h"
#include "simulation/file_text.h"

#include "base/nearest_name.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <new>
#include <sstream>

namespace taut
{
  namespace
  {
    using namespace dealii::Patterns;

    /// Names of the entries or sections of a node in deal.II's JSON listing.
    std::vector<std::string> names_in(const nlohmann::json &node, const bool sections)
    {
      std::vector<std::string> names;
      for (const auto &[name, child] : node.items())
        if (child.is_object() && child.contains("pattern_description") != sections)
          names.push_back(name);
      return names;
    }

    /// The names of a deal.II Selection, alone or in a List, from its description.
    std::vector<std::string> selection_of(const std::string &pattern)
    {
      std::vector<std::string> names;
      const std::string mark = "[Selection ";
      const std::size_t begin = pattern.find(mark);
      if (begin == std::string::npos)
        return names;
      std::istringstream list(
          pattern.substr(begin + mark.size(), pattern.find(" ]", begin) - begin - mark.size()));
      for (std::string name; std::getline(list, name, '|');)
        names.push_back(name);
      return names;
    }

    /// "; sections here: A, B." if a missing section is more likely than a misspelt entry.
    std::string sections_here(const std::string &name, const nlohmann::json &node)
    {
      std::string all;
      if (nearest_name(name, names_in(node, false)).empty())
        for (const std::string &section : names_in(node, true))
          all += (all.empty() ? " Sections here: " : ", ") + section;
      return all.empty() ? "" : all + ".";
    }

    /// Section "Wire <name>" for the names in a list, from its help; empty for another entry.
    std::string section_of_names(const nlohmann::json &entry)
    {
      const std::string help = entry["documentation"].get<std::string>(), mark = " <name>'";
      const std::size_t end = help.find(mark),
                        begin = end == std::string::npos ? end : help.rfind('\'', end - 1);
      return begin == std::string::npos ? "" : help.substr(begin + 1, end - begin - 1);
    }

    /// Checks that each listed name has its section in the file.
    void check_sections_of_names(const ParameterFile &file, const ParameterFile::Entry &entry,
                                 const nlohmann::json &described)
    {
      const std::string section = section_of_names(described);
      if (section.empty())
        return;
      for (const std::string &name : dealii::Utilities::split_string_list(entry.value, ','))
      {
        std::vector<std::string> path = entry.path;
        path.back() = section + " " + name;
        const auto begins = [&](const ParameterFile::Entry &other)
        {
          return other.path.size() >= path.size() &&
                 std::equal(path.begin(), path.end(), other.path.begin());
        };
        if (std::none_of(file.sections().begin(), file.sections().end(), begins) &&
            std::none_of(file.entries().begin(), file.entries().end(), begins))
          throw UserError(entry.place + ": " + entry.name() + " = '" + shortened(entry.value) +
                          "': there is no section '" + path.back() +
                          "', so that all would be defaults; add it, or remove '" + name + "'");
      }
    }

    /// "Or add 'a' to 'Wires'." for the section 'Wire a' of an item that the list of names lacks.
    std::string list_of(const std::string &section, const nlohmann::json &node)
    {
      const std::size_t space = section.rfind(' ');
      if (space == std::string::npos)
        return "";
      // The help of a list names its sections.
      for (const auto &[list, entry] : node.items())
        if (entry.contains("documentation"))
        {
          const std::string help = entry["documentation"].get<std::string>();
          for (std::size_t at = section.find(' '); at != std::string::npos;
               at = section.find(' ', at + 1))
            if (help.find("'" + section.substr(0, at) + " <name>'") != std::string::npos)
              return " Or add '" + section.substr(at + 1) + "' to the names in '" + list + "'.";
        }
      return "";
    }

    /// deal.II's description of a pattern as the middle of a sentence, without its largest numbers.
    std::string expectation(const PatternBase &pattern)
    {
      std::string text = pattern.description(PatternBase::Text);
      const auto replace = [&](const std::string &from, const std::string &to)
      {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from))
          text.replace(at, from.size(), to);
      };
      replace(" v such that -MAX_DOUBLE <= v <= MAX_DOUBLE", "");
      replace(" v such that 0 <= v <= MAX_DOUBLE", ", at least 0");
      replace(" <= MAX_DOUBLE", "");
      replace("1 to 4294967295 elements", "one or more elements");
      replace("0 to 4294967295 elements", "any number of elements");
      replace("2 to 2 elements", "2 elements");
      replace("A floating point number", "a number");
      replace(" where each element is [a number]", ", numbers with commas between them");
      replace(" where each element is [a number, at least 0]",
              ", numbers of at least 0 with commas between them");
      if (!text.empty())
        text[0] = std::tolower(static_cast<unsigned char>(text[0]));
      return text;
    }

    /// Error in a text that begins like a number, where a number is expected; may be empty.
    std::string hint(const std::string &value, const std::string &expected)
    {
      char *end = nullptr;
      std::strtod(value.c_str(), &end);
      const std::string rest = end;
      if (end == value.c_str() || rest.empty() || expected.find("number") == std::string::npos)
        return "";
      if (rest[0] == ',' && expected.compare(0, 6, "a list") != 0)
        return "; decimals have a point";
      if (std::isalpha(static_cast<unsigned char>(rest[rest.find_first_not_of(' ')])))
        return "; write the number alone, its unit is in the help of the entry";
      return "";
    }

    /// What to take in place of a value that a version dropped, see doc/changelog.md; empty: none.
    std::string replacement_of(const ParameterFile::Entry &entry)
    {
      if (entry.path.back() == "Interface operator" && entry.value == "condensed")
        return "; take 'assembled dense', which stores no columns of solids";
      if (entry.path.back() == "Preconditioner" && entry.value == "lumped")
        return "; take 'Dirichlet', which needs fewer iterations";
      return "";
    }

    /// Other places in the tree with an entry or section of this name, or a section that begins
    /// with it; at most two.
    void find_elsewhere(const nlohmann::json &node, const std::string &name, const bool section,
                        const std::string &path, std::vector<std::string> &places)
    {
      for (const auto &[key, child] : node.items())
      {
        if (!child.is_object() || places.size() > 1)
          continue;
        const bool is_section = !child.contains("pattern_description");
        if (is_section == section && (key == name || (section && key.rfind(name + " ", 0) == 0)))
          places.push_back(path + key);
        if (is_section)
          find_elsewhere(child, name, section, path + key + "/", places);
      }
    }

    /// " There is 'Catenary/Droppers/Positions'." for an entry in the wrong place.
    std::string elsewhere(const nlohmann::json &root, const std::string &name, const bool section)
    {
      std::vector<std::string> places;
      find_elsewhere(root, name, section, "", places);
      std::string text;
      for (const std::string &place : places)
        text += (text.empty() ? " There is '" : " and '") + place + "'";
      return text.empty() ? "" : text + ".";
    }

    /// Node of a path, or an error about the first section that does not exist.
    const nlohmann::json &find_section(const nlohmann::json &root,
                                       const ParameterFile::Entry &entry,
                                       const std::size_t n_sections)
    {
      const nlohmann::json *node = &root;
      for (std::size_t i = 0; i < n_sections; ++i)
      {
        const std::string &name = entry.path[i];
        if (!node->contains(name) || (*node)[name].contains("pattern_description"))
          throw UserError(entry.place + ": there is no section '" + name + "'" +
                          (i > 0 ? " in '" + entry.path[i - 1] + "'" : "") +
                          suggestion(name, names_in(*node, true)) + list_of(name, *node) +
                          elsewhere(root, name, true));
        node = &(*node)[name];
      }
      return *node;
    }
  } // namespace

  namespace
  {
    /// A name as it is declared; in XML deal.II writes other characters than letters and digits as
    /// '_' and two hexadecimal digits.
    std::string declared_name(const std::string &written)
    {
      std::string name;
      for (std::size_t i = 0; i < written.size(); ++i)
        if (written[i] == '_' && i + 2 < written.size())
        {
          name += static_cast<char>(std::stoi(written.substr(i + 1, 2), nullptr, 16));
          i += 2;
        }
        else
          name += written[i];
      return name;
    }

    nlohmann::json as_json(const boost::property_tree::ptree &node)
    {
      if (node.empty())
        return node.data();
      nlohmann::json result = nlohmann::json::object();
      const bool is_entry = node.count("pattern_description") > 0;
      for (const auto &[name, child] : node)
        result[is_entry ? name : declared_name(name)] = as_json(child);
      return result;
    }
  } // namespace

  nlohmann::json listing_of(const dealii::ParameterHandler &prm)
  {
    std::stringstream text;
    // Not as JSON, where deal.II takes a name with a dot for two. To sort the entries takes deal.II
    // longer than all else here; JSON sorts them itself.
    prm.print_parameters(text, dealii::ParameterHandler::XML |
                                   dealii::ParameterHandler::KeepDeclarationOrder);
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml(text, tree);
    const nlohmann::json listing = as_json(tree.get_child("ParameterHandler"));
    return listing.is_object() ? listing : nlohmann::json::object();
  }

  void check_entries(const ParameterFile &file, const nlohmann::json &listing)
  {
    for (const ParameterFile::Entry &section : file.sections())
      find_section(listing, section, section.path.size());
    for (const ParameterFile::Entry &entry : file.entries())
    {
      const nlohmann::json &node = find_section(listing, entry, entry.path.size() - 1);
      const std::string &name = entry.path.back();
      if (!node.contains(name) || !node[name].contains("pattern_description"))
        throw UserError(
            entry.place + ": there is no entry '" + name + "'" +
            (entry.path.size() > 1 ? " in '" + entry.path[entry.path.size() - 2] + "'" : "") +
            suggestion(name, names_in(node, false)) + sections_here(name, node) +
            elsewhere(listing, name, false));
      const auto pattern = pattern_factory(node[name]["pattern_description"].get<std::string>());
      if (!pattern) // a stream that found no memory cut the description off
        throw std::bad_alloc();
      if (!pattern->match(entry.value))
      {
        const std::string near = nearest_name(
            entry.value, selection_of(node[name]["pattern_description"].get<std::string>()));
        throw UserError(entry.place + ": " + entry.name() + " = '" + shortened(entry.value) +
                        "' is not allowed; expected " + expectation(*pattern) +
                        hint(entry.value, expectation(*pattern)) + replacement_of(entry) +
                        (near.empty() ? "" : "; did you mean '" + near + "'?"));
      }
      check_sections_of_names(file, entry, node[name]);
    }
  }
} // namespace taut
