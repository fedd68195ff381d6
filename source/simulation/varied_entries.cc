// SPDX-License-Identifier: LGPL-2.1-or-later
#include "file_text.h"

#include <taut/base/exceptions.h>
#include <taut/base/nearest_name.h>
#include <taut/output/table_file.h>
#include <taut/simulation/varied_entries.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace taut
{
  namespace
  {
    std::optional<double> number(const std::string &text)
    {
      double value = 0.;
      const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
      return result.ec == std::errc() && result.ptr == text.data() + text.size() &&
                     std::isfinite(value)
                 ? std::optional<double>(value)
                 : std::nullopt;
    }

    /// A value, or all values of "first:step:last".
    std::vector<std::string> expanded(const std::string &text, const std::string &entry,
                                      const std::size_t most)
    {
      const std::vector<std::string> parts = split(text, ':');
      std::vector<double> numbers;
      for (const std::string &part : parts)
        if (const auto value = number(part))
          numbers.push_back(*value);
      if (parts.size() != 3 || numbers.size() != 3)
        return {text};
      const double n = (numbers[2] - numbers[0]) / numbers[1];
      constexpr double rounding = 1e-9;
      if (!(n >= -rounding) || !(n < most))
        throw EntryError(entry, "'" + text +
                                    "' never gets from its first to its last value, or "
                                    "has too many; write first:step:last");
      std::vector<std::string> values;
      for (std::size_t i = 0; i <= n + rounding; ++i)
        values.push_back(time_text(numbers[0] + i * numbers[1]));
      return values;
    }

    bool begins(const std::string &path, const std::string &head)
    {
      return path.compare(0, head.size(), head) == 0;
    }

    /// Whether an entry is about results or the use of the scene.
    bool is_outside_of_scene(const std::string &path)
    {
      return begins(path, "Study/") || begins(path, "Sweep/") ||
             (begins(path, "Output/") && !begins(path, "Output/Probe"));
    }
  } // namespace

  void VariedEntries::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Anything;
    prm.add_parameter("Entries", entries,
                      "Paths of the entries that take each value together, 'Section/Entry', "
                      "separated by commas",
                      Anything());
    prm.add_parameter("Values", values,
                      "Separated by commas, or by semicolons if a value is itself a list; a range "
                      "is first:step:last, with its ends",
                      Anything());
  }

  std::vector<std::string> VariedEntries::paths(const std::string &title,
                                                const std::map<std::string, std::string> &scene,
                                                std::set<std::string> &taken) const
  {
    const std::string entry = title + "/Entries";
    const std::vector<std::string> paths = split(entries, ',');
    if (paths.empty())
      throw EntryError(entry, "name the entries that take the values");
    for (const std::string &path : paths)
    {
      if (scene.count(path) == 0)
      {
        std::vector<std::string> known;
        for (const auto &[name, value] : scene)
          known.push_back(name);
        throw EntryError(entry, "there is no entry '" + path +
                                    "'; write its sections and its name, 'Time/Step'" +
                                    suggestion(path, known));
      }
      if (is_outside_of_scene(path))
        throw EntryError(entry, "'" + path +
                                    "' is not part of the scene or of how it is solved; take "
                                    "another entry");
      if (!taken.insert(path).second)
        throw EntryError(entry,
                         "'" + path + "' is varied twice; remove it from one of the parameters");
    }
    return paths;
  }

  std::vector<std::string> VariedEntries::value_list(const std::string &title,
                                                     const std::size_t most) const
  {
    const std::string entry = title + "/Values";
    std::vector<std::string> list;
    for (const std::string &value :
         split(values, values.find(';') != std::string::npos ? ';' : ','))
      for (std::string &one : expanded(value, entry, most))
        list.push_back(std::move(one));
    if (list.empty() || std::count(list.begin(), list.end(), std::string()) > 0)
      throw EntryError(entry, "give one or more values, none of them empty");
    return list;
  }
} // namespace taut
