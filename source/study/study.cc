// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/study.h"
#include "base/interruption.h"
#include "base/memory.h"
#include "study/study_report.h"
#include <taut/base/exceptions.h>
#include <taut/output/table_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <ostream>
#include <sstream>

namespace taut
{
  namespace
  {
    std::string on_one_line(std::string text)
    {
      std::replace(text.begin(), text.end(), '\n', ' ');
      return text;
    }
  } // namespace

  Study::Study(const std::string &file, const std::vector<std::string> &overrides,
               const bool overwrite, std::ostream &log)
      : file(file), overrides(overrides), overwrite(overwrite), log(log)
  {
    this->overrides.push_back("Study/Accuracy=0");
    parameters.read(file, this->overrides);
    const StudyParameters &study = parameters.study;
    const auto refuse = [&](const std::string &entry, const std::string &message)
    { throw UserError(parameters.explain(EntryError(entry, message))); };
    if (study.parameter_list_items.names.empty())
      refuse("Study/Parameters", "a study needs one or more lists of values to try");
    if (study.quantities.names.empty())
      refuse("Study/Quantities", "a study needs one or more quantities to measure the error of");
    if (!(parameters.end_time > 0.))
      refuse("Time/End", "a study measures runs in time; take a later end");
    result.parameter_lists = study.parameter_lists(parameters.values());
    result.quantity_names = study.quantities.names;
    result.end_time = parameters.end_time;
  }

  const StudyResult &Study::run()
  {
    try
    {
      make_settings();
      check_quantities(parameters);
      prepare_study_folder(parameters.study_folder(), overwrite);
      find_references();
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters.explain(e));
    }
    catch (const Interrupted &e)
    {
      std::filesystem::remove_all(parameters.study_folder() + "/run");
      throw Interrupted(e.signal(), "study ended by " + signal_name(e.signal()) +
                                        " before the first setting was measured");
    }
    const std::size_t n_settings = result.settings.size();
    log << n_settings << " settings, " << parameters.study.repeats << " runs each\n";
    try
    {
      measure_settings();
    }
    catch (const Interrupted &e)
    {
      keep_measured_settings();
      write_results();
      throw Interrupted(e.signal(), "study ended by " + signal_name(e.signal()) + " with " +
                                        std::to_string(result.settings.size()) + " of " +
                                        std::to_string(n_settings) + " settings measured");
    }
    write_results();
    return result;
  }

  void Study::measure_settings()
  {
    // All settings in turn, and again: a busy spell of the machine then meets few runs of each.
    for (unsigned int repeat = 0; repeat <= parameters.study.repeats; ++repeat)
      for (StudySetting &setting : result.settings)
        run_setting(setting, repeat == 0);
  }

  /// Keeps the measured settings of a study that ends early. A setting without a run for its cost
  /// alone has the cost of its run with output; costs of both kinds are not compared.
  void Study::keep_measured_settings()
  {
    std::vector<StudySetting> &settings = result.settings;
    settings.erase(std::remove_if(settings.begin(), settings.end(),
                                  [](const StudySetting &setting) {
                                    return setting.quantities.empty() && setting.message.empty();
                                  }),
                   settings.end());
    result.is_partial = true;
    const bool all_timed =
        std::all_of(settings.begin(), settings.end(),
                    [](const StudySetting &setting)
                    { return !setting.seconds.empty() || !setting.message.empty(); });
    if (all_timed)
      return;
    log << "Partial study: costs are those of the runs with output\n";
    for (StudySetting &setting : settings)
      setting.seconds = {setting.seconds_with_output};
  }

  void Study::write_results()
  {
    std::filesystem::remove_all(parameters.study_folder() + "/run");
    if (result.is_partial && result.settings.empty())
      return;
    find_bounds(result.parameter_lists, result.settings);
    find_front(result.settings);
    write_work_precision(result, parameters.study_folder() + "/work_precision.csv");
    write_study(result, parameters.values(), parameters.study_folder() + "/study.json");
    print_study(result, parameters.study.accuracies, log);
    log << "Study in " << parameters.study_folder() << '\n';
  }

  void Study::make_settings()
  {
    constexpr std::size_t most_settings = 10000;
    std::size_t n = 1;
    for (const ParameterList &parameter_list : result.parameter_lists)
      n = std::min(n * parameter_list.values.size(), most_settings + 1);
    if (n > most_settings)
      throw EntryError("Study/Parameters", "they make more than 10000 settings; take fewer values");
    for (std::size_t i = 0; i < n; ++i)
    {
      StudySetting setting;
      std::size_t rest = i;
      for (const ParameterList &parameter_list : result.parameter_lists)
      {
        setting.values.push_back(parameter_list.values[rest % parameter_list.values.size()]);
        rest /= parameter_list.values.size();
      }
      result.settings.push_back(std::move(setting));
    }
  }

  std::vector<std::string> Study::reference_values(const unsigned int level) const
  {
    std::vector<std::string> values;
    for (const ParameterList &parameter_list : result.parameter_lists)
    {
      double least = std::numeric_limits<double>::infinity();
      if (parameter_list.refined)
        for (const std::string &value : parameter_list.values)
          least = std::min(least, std::stod(value));
      values.push_back(parameter_list.refined
                           ? csv_number(std::ldexp(least, -static_cast<int>(level)))
                           : parameter_list.reference);
    }
    return values;
  }

  void Study::find_references()
  {
    const StudyParameters &study = parameters.study;
    const std::size_t n = study.quantities.items.size();
    const double wanted =
        study.accuracies.empty()
            ? 0.
            : .1 * *std::min_element(study.accuracies.begin(), study.accuracies.end());
    result.references.assign(n, {});
    bool all_exact = true;
    for (std::size_t i = 0; i < n; ++i)
    {
      result.references[i].is_exact = !study.quantities.items[i].exact.empty();
      all_exact = all_exact && result.references[i].is_exact;
    }
    std::vector<std::vector<StudyQuantity>> levels(n); // of each quantity
    for (unsigned int level = 0; level < (all_exact ? 1 : study.reference_levels); ++level)
    {
      const std::vector<std::string> values = reference_values(level);
      log << "Reference:";
      for (std::size_t k = 0; k < values.size(); ++k)
        log << (k > 0 ? ", " : " ") << result.parameter_lists[k].name << " = " << values[k];
      const MeasuredRun run = run_once(values, false, true);
      if (!all_exact && !run.unseen.empty() && level + 1 == study.reference_levels)
        throw UserError("the finest reference does not see all of the scene: " + run.unseen +
                        "; give finer values, or more Study/Reference levels");
      bool done = level > 0 && run.unseen.empty();
      for (std::size_t i = 0; i < n; ++i)
      {
        QuantityReference &reference = result.references[i];
        const StudyParameters::QuantityItem &item = study.quantities.items[i];
        const std::string title = study.quantities.title(i);
        levels[i].push_back(run.quantities[i]);
        if (reference.is_exact)
          reference.quantity = exact_quantity(item.exact, title + "/Exact", run.quantities[i]);
        else
          reference = extrapolate(levels[i]);
        reference.scale = item.scale > 0. ? item.scale : std::fabs(reference.quantity.value);
        if (!(reference.scale > 0.))
          throw EntryError(title + "/Scale", "the reference is 0: give a scale for its errors");
        log << "; " << study.quantities.names[i] << " " << run.quantities[i].value;
        done = done && reference.error <= wanted * reference.scale;
      }
      log << std::endl;
      if (done)
        break;
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      const QuantityReference &reference = result.references[i];
      log << "  " << study.quantities.names[i] << ": " << csv_number(reference.quantity.value);
      if (reference.is_exact)
        log << ", exact\n";
      else
        log << " +- " << reference.error << ", relative " << reference.error / reference.scale
            << ", observed order " << reference.order
            << (reference.error <= wanted * reference.scale
                    ? "\n"
                    : ": not as accurate as wanted; more Reference levels or finer values\n");
    }
  }

  MeasuredRun Study::run_once(const std::vector<std::string> &values, const bool with_output,
                              const bool with_quantities) const
  {
    std::vector<std::string> all = overrides;
    for (std::size_t k = 0; k < values.size(); ++k)
      for (const std::string &entry : result.parameter_lists[k].entries)
        all.push_back(entry + "=" + values[k]);
    all.push_back("Output/Folder=" + parameters.study_folder() + "/run");
    Parameters chosen;
    set_origins(chosen);
    chosen.read(file, all);
    if (!with_output)
    {
      chosen.output.interval = chosen.output.link_interval = 2. * chosen.end_time;
      chosen.output.field_interval = 0.;
    }
    chosen.output.overwrite = true;
    return measure_run(chosen, with_quantities, stop_asked);
  }

  /// Messages about varied entries say where their values are written.
  void Study::set_origins(Parameters &chosen) const
  {
    const StudyParameters &study = parameters.study;
    for (std::size_t k = 0; k < result.parameter_lists.size(); ++k)
      for (const std::string &entry : result.parameter_lists[k].entries)
        chosen.set_origin(entry,
                          parameters.place_of(study.parameter_list_items.title(k) + "/Values"));
    chosen.set_origin("Output/Folder", parameters.place_of("Study/Folder"));
  }

  void Study::run_setting(StudySetting &setting, const bool first) const
  {
    if (!setting.message.empty())
      return;
    try
    {
      const MeasuredRun run = run_once(setting.values, first, first);
      if (!first)
      {
        setting.seconds.push_back(run.seconds);
        return;
      }
      setting.seconds_with_output = run.seconds;
      setting.certificate = run.certificate;
      setting.n_steps = run.n_steps;
      compare(setting, run.quantities);
    }
    catch (const NotWritten &)
    {
      throw; // the next setting would fail, too
    }
    catch (const UserError &e)
    {
      setting.message = on_one_line(e.what());
    }
    catch (const std::exception &e)
    {
      if (!is_memory_shortage(e))
        throw;
      setting.message = "more memory than there is";
    }
    if (!first)
      return;
    for (std::size_t k = 0; k < setting.values.size(); ++k)
      log << (k > 0 ? ", " : "  ") << result.parameter_lists[k].name << " = " << setting.values[k];
    if (setting.message.empty())
      log << ": error " << setting.error << ", " << setting.seconds_with_output << " s"
          << std::endl;
    else
      log << ": failed" << std::endl; // print_study() says why
  }

  void Study::compare(StudySetting &setting, const std::vector<StudyQuantity> &quantities) const
  {
    for (std::size_t i = 0; i < quantities.size(); ++i)
    {
      const QuantityReference &reference = result.references[i];
      const StudyQuantity exact =
          reference.is_exact
              ? exact_quantity(parameters.study.quantities.items[i].exact,
                               parameters.study.quantities.title(i) + "/Exact", quantities[i])
              : reference.quantity;
      setting.quantities.push_back(quantities[i].value);
      setting.errors.push_back(distance(quantities[i], exact) / reference.scale);
      setting.reference_error =
          std::max(setting.reference_error, reference.error / reference.scale);
    }
    setting.error = *std::max_element(setting.errors.begin(), setting.errors.end());
    if (!std::isfinite(setting.error))
      setting.message = "the quantities are not finite";
  }
} // namespace taut
