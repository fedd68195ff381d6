// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/study_report.h"
#include "base/write_file.h"
#include "simulation/stored_study.h"
#include <taut/base/exceptions.h>
#include <taut/base/version.h>
#include <taut/output/table_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <ostream>
#include <utility>

namespace taut
{
  namespace
  {
    std::string describe(const StudyResult &result, const StudySetting &setting)
    {
      std::string text;
      for (std::size_t k = 0; k < setting.values.size(); ++k)
        text += (k > 0 ? ", " : "") + result.parameter_lists[k].name + " = " + setting.values[k];
      return text;
    }

    std::string refined_values(const StudyResult &result, const StudySetting &setting)
    {
      std::string text;
      for (std::size_t k = 0; k < setting.values.size(); ++k)
        if (result.parameter_lists[k].refined)
          text += (text.empty() ? "" : ", ") + setting.values[k];
      return text;
    }

    /// A line of the table.
    void print_setting(const StudyResult &result, const StudySetting &setting, std::ostream &out)
    {
      for (const std::string &value : setting.values)
        out << "| " << value << ' ';
      out << std::setprecision(2) << "| " << setting.error << " | " << setting.bound << " | "
          << std::fixed << std::setprecision(1) << 1e6 * setting.least_seconds() / setting.n_steps
          << " | " << result.end_time / setting.least_seconds() << " | "
          << result.end_time / setting.seconds_with_output << " |\n"
          << std::defaultfloat;
    }
    /// The values of a setting on the parameter lists that are not refined, "BDF2, string": the
    /// table compares these groups of settings.
    std::string kind(const StudyResult &result, const StudySetting &setting)
    {
      std::string text;
      for (std::size_t k = 0; k < setting.values.size(); ++k)
        if (!result.parameter_lists[k].refined)
          text += (text.empty() ? "" : ", ") + setting.values[k];
      return text;
    }

    /// The cheapest setting of each group for each accuracy.
    void print_kinds(const StudyResult &result, const std::vector<double> &accuracies,
                     std::ostream &out)
    {
      std::vector<std::string> kinds;
      for (const StudySetting &setting : result.settings)
        if (std::count(kinds.begin(), kinds.end(), kind(result, setting)) == 0)
          kinds.push_back(kind(result, setting));
      if (kinds.size() < 2 || accuracies.empty())
        return;
      out << "What each can do: x real time of its cheapest setting for an error of\n\n|";
      for (const ParameterList &parameter_list : result.parameter_lists)
        if (!parameter_list.refined)
          out << ' ' << parameter_list.name;
      out << " | ";
      for (const double accuracy : accuracies)
        out << std::setprecision(6) << 100. * accuracy << " % | ";
      out << "least error | failed |\n|---|";
      for (std::size_t i = 0; i < accuracies.size(); ++i)
        out << "---|";
      out << "---|---|\n";
      for (const std::string &name : kinds)
      {
        std::vector<StudySetting> own;
        for (const StudySetting &setting : result.settings)
          if (kind(result, setting) == name)
            own.push_back(setting);
        out << "| " << name << " | ";
        for (const double accuracy : accuracies)
        {
          if (const StudySetting *best = cheapest(own, accuracy))
            out << std::setprecision(3) << result.end_time / best->least_seconds() << " ("
                << refined_values(result, *best) << ") | ";
          else
            out << "- | ";
        }
        double least = std::numeric_limits<double>::infinity();
        int n_failed = 0;
        for (const StudySetting &setting : own)
          if (setting.message.empty())
            least = std::min(least, setting.bound);
          else
            ++n_failed;
        out << std::setprecision(2) << least << " | " << n_failed << " |\n";
      }
      out << '\n';
    }

    /// A message without the value of its entry, "file:line: Section/Entry = 'value': reason".
    std::string without_value(const std::string &message)
    {
      const std::string mark = " = '";
      const std::size_t begin = message.find(mark),
                        end = begin == std::string::npos ? begin
                                                         : message.find('\'', begin + mark.size());
      return end == std::string::npos ? message : message.substr(0, begin) + message.substr(end);
    }

    /// A line for each reason, with the first of the values that have it.
    void print_reasons(const StudyResult &result, std::ostream &out)
    {
      std::vector<std::pair<std::string, std::size_t>> reasons; // messages and how often
      for (const StudySetting &setting : result.settings)
      {
        if (setting.message.empty())
          continue;
        const auto known =
            std::find_if(reasons.begin(), reasons.end(),
                         [&](const auto &reason)
                         { return without_value(reason.first) == without_value(setting.message); });
        if (known == reasons.end())
          reasons.emplace_back(setting.message, 1);
        else
          ++known->second;
      }
      for (const auto &[message, n] : reasons)
        out << "  " << n << (n == 1 ? " setting: " : " settings: ") << message << '\n';
    }
  } // namespace

  void prepare_study_folder(const std::string &folder, const bool overwrite)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::exists(folder + "/study.json", error) && !overwrite)
      throw EntryError("Study/Folder", "'" + folder +
                                           "' holds a study; name another folder, or run with "
                                           "--overwrite");
    fs::create_directories(folder, error);
    if (error)
      throw EntryError("Study/Folder", "cannot make '" + folder + "': " + error.message());
  }

  void print_study(const StudyResult &result, const std::vector<double> &accuracies,
                   std::ostream &out)
  {
    const auto flags = out.flags();
    const auto precision = out.precision();
    std::string head = "|", rule = "|";
    for (const ParameterList &parameter_list : result.parameter_lists)
    {
      head += " " + parameter_list.name + " |";
      rule += "---|";
    }
    out << "The settings that nothing beats in both cost and error:\n\n"
        << head << " error | of finer ones too | us a step | x real time | with output |\n"
        << rule << "---|---|---|---|---|\n";
    std::vector<const StudySetting *> front;
    std::size_t n_failed = 0;
    for (const StudySetting &setting : result.settings)
    {
      if (setting.is_on_front)
        front.push_back(&setting);
      n_failed += !setting.message.empty();
    }
    std::sort(front.begin(), front.end(),
              [](const StudySetting *a, const StudySetting *b)
              { return a->least_seconds() < b->least_seconds(); });
    for (const StudySetting *setting : front)
      print_setting(result, *setting, out);
    out << '\n';
    print_kinds(result, accuracies, out);
    const auto name_cheapest = [&](const std::string &of, const StudySetting *best)
    {
      out << "  " << of << ": ";
      if (best)
        out << describe(result, *best) << "; " << std::setprecision(3)
            << result.end_time / best->least_seconds() << " x real time\n";
      else
        out << "none of these settings\n";
    };
    for (const double accuracy : accuracies)
    {
      out << "Cheapest for an error of " << std::setprecision(6) << 100. * accuracy
          << " %, its own, that of all finer settings and that of the reference:\n";
      name_cheapest("all quantities", cheapest(result.settings, accuracy));
      if (result.quantity_names.size() > 1)
        for (std::size_t i = 0; i < result.quantity_names.size(); ++i)
          name_cheapest(result.quantity_names[i], cheapest(result, i, accuracy));
    }
    if (n_failed > 0)
    {
      out << n_failed << " settings failed; the reasons are in work_precision.csv\n";
      print_reasons(result, out);
    }
    out.flags(flags);
    out.precision(precision);
  }

  void write_work_precision(const StudyResult &result, const std::string &path)
  {
    std::vector<std::string> columns;
    for (const ParameterList &parameter_list : result.parameter_lists)
      columns.push_back(parameter_list.name);
    for (const char *name :
         {"error [1]", "error of finer ones too [1]", "error of the reference [1]", "seconds",
          "median seconds", "seconds with output", "steps", "us a step", "x real time",
          "certificate [1]", "front"})
      columns.push_back(name);
    for (const std::string &name : result.quantity_names)
    {
      columns.push_back(name);
      columns.push_back(name + " error [1]");
    }
    columns.push_back("message");
    TableFile file(path, columns);
    for (const StudySetting &setting : result.settings)
    {
      for (const std::string &value : setting.values)
        file << value;
      if (!setting.message.empty())
      {
        for (std::size_t i = setting.values.size(); i + 1 < columns.size(); ++i)
          file << std::string();
        file << setting.message;
        file.end_line();
        continue;
      }
      const double seconds = setting.least_seconds();
      file << setting.error << setting.bound << setting.reference_error << seconds
           << setting.median_seconds() << setting.seconds_with_output
           << static_cast<double>(setting.n_steps) << 1e6 * seconds / setting.n_steps
           << result.end_time / seconds << setting.certificate
           << static_cast<double>(setting.is_on_front);
      for (std::size_t i = 0; i < setting.quantities.size(); ++i)
        file << setting.quantities[i] << setting.errors[i];
      file << std::string();
      file.end_line();
    }
    file.close();
  }

  void write_study(const StudyResult &result, const std::map<std::string, std::string> &scene,
                   const std::string &path)
  {
    using nlohmann::json;
    json root;
    root["taut"] = version();
    root["end [s]"] = result.end_time;
    root["partial"] = result.is_partial;
    root["scene"] = json::object();
    for (const auto &[entry, value] : scene)
      if (!is_irrelevant_for_study(entry))
        root["scene"][entry] = value;
    root["parameters"] = json::array();
    for (const ParameterList &parameter_list : result.parameter_lists)
      root["parameters"].push_back({{"name", parameter_list.name},
                                    {"entries", parameter_list.entries},
                                    {"values", parameter_list.values}});
    root["quantities"] = json::array();
    for (std::size_t i = 0; i < result.quantity_names.size(); ++i)
    {
      const QuantityReference &reference = result.references[i];
      root["quantities"].push_back({{"name", result.quantity_names[i]},
                                    {"reference", reference.quantity.value},
                                    {"error of the reference", reference.error},
                                    {"observed order", reference.order},
                                    {"scale", reference.scale},
                                    {"exact", reference.is_exact}});
    }
    root["settings"] = json::array();
    for (const StudySetting &setting : result.settings)
    {
      json entry;
      for (std::size_t k = 0; k < setting.values.size(); ++k)
        entry["values"][result.parameter_lists[k].name] = setting.values[k];
      if (!setting.message.empty())
        entry["message"] = setting.message;
      else
      {
        entry["error"] = setting.bound;
        entry["error of the reference"] = setting.reference_error;
        entry["seconds"] = setting.least_seconds();
        entry["cost"] = setting.cost();
        entry["x real time"] = result.end_time / setting.least_seconds();
      }
      root["settings"].push_back(entry);
    }
    write_file(path, root.dump(2) + '\n');
  }
} // namespace taut
