// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/stored_study.h"
#include "base/text.h"
#include <taut/base/exceptions.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

namespace taut
{
  namespace
  {
    using nlohmann::json;
    constexpr const char *entry_name = "Study/Accuracy";

    json read_study(const std::string &file)
    {
      std::ifstream in(file);
      if (!in)
        throw EntryError(entry_name, "there is no study '" + file +
                                         "'; make it with 'taut --study' or '--accuracy', or name "
                                         "its folder in Study/Folder");
      try
      {
        return json::parse(in);
      }
      catch (const json::exception &)
      {
        throw EntryError(entry_name,
                         "'" + file + "' is damaged; make the study anew with 'taut --study'");
      }
    }

    /// Equal as text or as numbers.
    bool same_value(const std::string &a, const std::string &b)
    {
      if (a == b)
        return true;
      std::istringstream left(a), right(b);
      std::string x, y;
      while (true)
      {
        const bool more = !std::getline(left, x, ',').fail();
        if (more != !std::getline(right, y, ',').fail())
          return false;
        if (!more)
          return true;
        std::istringstream first(x), second(y);
        double p = 0., q = 0.;
        if (!(first >> p && second >> q && (first >> std::ws).eof() && (second >> std::ws).eof() &&
              p == q))
          return false;
      }
    }

    /// Difference between two scenes, except in varied entries; empty: none.
    std::string difference(const std::map<std::string, std::string> &scene, const json &studied,
                           const std::set<std::string> &varied)
    {
      constexpr int most_named = 3;
      int n = 0;
      std::string text;
      const auto name =
          [&](const std::string &path, const std::string &here, const std::string &there)
      {
        if (++n <= most_named)
          text +=
              (n > 1 ? ", " : "") + path + " is " + here + " here and " + there + " in the study";
      };
      for (const auto &[path, value] : scene)
        if (varied.count(path) == 0 && !is_irrelevant_for_study(path))
        {
          if (!studied.contains(path))
            name(path, "'" + value + "'", "missing");
          else if (!same_value(value, studied.at(path).get<std::string>()))
            name(path, "'" + value + "'", "'" + studied.at(path).get<std::string>() + "'");
        }
      for (const auto &[path, value] : studied.items())
        if (scene.count(path) == 0 && varied.count(path) == 0)
          name(path, "missing", "'" + value.get<std::string>() + "'");
      if (n > most_named)
        text += ", and " + std::to_string(n - most_named) + " more";
      return text;
    }

    StudyChoice choose(const json &study, const std::string &file, const double accuracy,
                       const std::map<std::string, std::string> &scene)
    {
      std::set<std::string> varied;
      for (const json &parameter_list : study.at("parameters"))
        for (const json &entry : parameter_list.at("entries"))
          varied.insert(entry.get<std::string>());
      for (const std::string &path : varied)
        if (scene.count(path) == 0)
          throw EntryError(entry_name, "the study '" + file + "' varies '" + path +
                                           "', which this scene has not; it is of another scene");
      const std::string other = difference(scene, study.at("scene"), varied);
      if (!other.empty())
        throw EntryError(entry_name, "the study '" + file + "' is of another scene: " + other +
                                         "; make it anew with 'taut --study'");

      const json *best = nullptr;
      double least_error = std::numeric_limits<double>::infinity();
      for (const json &setting : study.at("settings"))
      {
        if (!setting.contains("error"))
          continue; // failed setting
        const double error =
            setting.at("error").get<double>() + setting.at("error of the reference").get<double>();
        least_error = std::min(least_error, error);
        // Of settings that cost the same the coarsest, as cheapest() of a study.
        const auto rank = [](const json &one)
        { return std::pair(one.at("cost").get<double>(), -one.at("error").get<double>()); };
        if (error <= accuracy && (!best || rank(setting) < rank(*best)))
          best = &setting;
      }
      if (!best)
      {
        throw EntryError(entry_name,
                         to_text("the best setting in '", file, "' has an error of ", least_error,
                                 "; ask for less accuracy, or give the study finer values"));
      }
      StudyChoice choice;
      std::ostringstream text;
      text << "Accuracy " << accuracy << ": ";
      const json &values = best->at("values");
      for (const json &parameter_list : study.at("parameters"))
      {
        const std::string name = parameter_list.at("name").get<std::string>(),
                          value = values.at(name).get<std::string>();
        text << name << " = " << value << ", ";
        for (const json &entry : parameter_list.at("entries"))
          choice.overrides.push_back(entry.get<std::string>() + "=" + value);
      }
      text << "error " << best->at("error").get<double>() << " (of the reference "
           << best->at("error of the reference").get<double>() << "), "
           << best->at("x real time").get<double>() << " x real time when it was studied, in '"
           << file << "'";
      choice.description = text.str();
      return choice;
    }
  } // namespace

  bool is_irrelevant_for_study(const std::string &path)
  {
    const auto begins = [&](const std::string &head)
    { return path.compare(0, head.size(), head) == 0; };
    return begins("Study/") || begins("Sweep/") || begins("Statistics/Expected ranges/") ||
           (begins("Output/") && !begins("Output/Probe"));
  }

  StudyChoice choose_setting(const std::string &file, const double accuracy,
                             const std::map<std::string, std::string> &scene)
  {
    const json study = read_study(file);
    try
    {
      return choose(study, file, accuracy, scene);
    }
    catch (const json::exception &)
    {
      throw EntryError(entry_name, "'" + file +
                                       "' is not a study of this version of Taut; make it anew "
                                       "with 'taut --study'");
    }
  }
} // namespace taut
