// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene_text.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace hunt
{
  double Random::uniform(const double a, const double b)
  {
    return a + (b - a) * std::ldexp(static_cast<double>(engine() >> 11), -53);
  }

  double Random::decades(const double a, const double b)
  {
    return std::pow(10., uniform(a, b));
  }

  int Random::integer(const int first, const int last)
  {
    return first + static_cast<int>(uniform(0., last - first + 1.));
  }

  std::string number(const double x)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.15g", x);
    return text;
  }

  double short_number(const double x)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.2e", x);
    return std::atof(text);
  }

  void SceneText::add(const std::string &kind, const std::string &name, const Entries &entries)
  {
    const std::string list = kind == "Mass"         ? "Masses"
                             : kind == "Point mass" ? "Point masses"
                                                    : kind + "s";
    bool found = false;
    for (auto &[known, all] : names)
      if (known == list)
      {
        all += ", " + name;
        found = true;
      }
    if (!found)
      names.emplace_back(list, name);
    items += "  subsection " + kind + " " + name + "\n";
    for (const auto &[entry, value] : entries)
      items += "    set " + entry + " = " + value + "\n";
    items += "  end\n";
  }

  void SceneText::set(const std::string &section, const std::string &entry,
                      const std::string &value)
  {
    const std::string line = "set " + entry + " = " + value + "\n";
    for (auto &[known, lines] : sections)
      if (known == section)
      {
        lines += line;
        return;
      }
    sections.emplace_back(section, line);
  }

  std::string SceneText::text() const
  {
    std::string result = "set Generator = network\n";
    for (const auto &[section, lines] : sections)
      if (section.empty())
        result += lines;
    result += "subsection Network\n";
    for (const auto &[list, all] : names)
      result += "  set " + list + " = " + all + "\n";
    result += items + "end\n";
    for (const auto &[section, lines] : sections)
      if (!section.empty())
        result += section + "\n" + lines +
                  std::string(section.find('\n') == std::string::npos ? "end\n" : "end\nend\n");
    return result;
  }
} // namespace hunt
