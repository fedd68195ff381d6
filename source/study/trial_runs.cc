// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/trial_runs.h"
#include "base/interruption.h"
#include "study/case_runner.h"
#include "study/quantity_recorder.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <csignal>

namespace taut
{
  namespace
  {
    /// Levels beyond that of the file at which quantities are looked for.
    constexpr int most_finer_for_names = 3;
  } // namespace

  TrialRuns::TrialRuns(std::string file, std::vector<std::string> overrides)
      : file(std::move(file)), overrides(std::move(overrides))
  {
    this->overrides.push_back("Study/Accuracy=0");
    file_parameters.read(this->file, this->overrides);
    const auto refuse = [&](const std::string &entry, const std::string &message)
    { throw UserError(file_parameters.explain(EntryError(entry, message))); };
    if (!(file_parameters.end_time > 0.))
      refuse("Time/End", "an accuracy is found from runs in time; take a later end");
    if (file_parameters.step_parameters.adaptive())
      refuse("Time/Step control", "a search compares fixed steps; set 'fixed'");
    all_refinements = find_refinements(file_parameters.values());
  }

  double TrialRuns::elapsed() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  int TrialRuns::ask() const
  {
    const int signal = stop_asked ? stop_asked() : 0;
    return signal == 0 && elapsed() > file_parameters.study.budget ? SIGALRM : signal;
  }

  /// The entries at these levels. Steps are not checked by other runs: the search does more.
  std::vector<std::string> TrialRuns::entries(const Levels &levels) const
  {
    std::vector<std::string> list = {"Time/Check steps=no"};
    for (std::size_t d = 0; d < all_refinements.size(); ++d)
    {
      const std::vector<std::string> values = all_refinements[d].values(levels[d]);
      for (std::size_t g = 0; g < values.size(); ++g)
        for (const std::string &entry : all_refinements[d].groups[g].entries)
          list.push_back(entry + "=" + values[g]);
    }
    return list;
  }

  void TrialRuns::name_quantities()
  {
    if (!file_parameters.study.quantities.names.empty())
      return;
    CaseRunner runner(file, overrides);
    runner.stop_if([this]() { return ask(); });
    std::vector<std::string> names;
    // A coarse run may fail, or see nothing move.
    for (Levels levels(all_refinements.size(), 0); names.empty(); ++levels[0])
      try
      {
        names = default_quantities(runner.run(entries(levels)).quantities);
      }
      catch (const UserError &e)
      {
        if (levels[0] >= all_refinements[0].n_coarser + most_finer_for_names)
        {
          if (const auto *const of_entry = dynamic_cast<const EntryError *>(&e))
            throw UserError(file_parameters.explain(*of_entry));
          throw;
        }
        for (std::size_t d = 1; d < levels.size(); ++d)
          levels[d] = std::min(levels[d] + 1, all_refinements[d].n_coarser);
      }
    overrides.insert(overrides.end(), names.begin(), names.end());
    file_parameters.read(file, overrides);
  }

  MeasuredRun TrialRuns::run_once(const std::vector<std::string> &entries) const
  {
    if (const int signal = ask())
      throw Interrupted(signal, "");
    std::vector<std::string> all = overrides;
    all.insert(all.end(), entries.begin(), entries.end());
    Parameters chosen;
    for (const std::string &entry : entries)
      chosen.set_origin(entry.substr(0, entry.find('=')), "--accuracy");
    chosen.read(file, all);
    chosen.write_nothing();
    return measure_run(chosen, true, [this]() { return ask(); });
  }

  const TrialRuns::Trial &TrialRuns::at(const Levels &levels)
  {
    const auto known = trials.find(levels);
    if (known != trials.end())
      return known->second;
    Trial trial;
    const double start = elapsed();
    try
    {
      trial.run = run_once(entries(levels));
      trial.message = trial.run.unseen;
      for (const StudyQuantity &quantity : trial.run.quantities)
        if (!std::isfinite(quantity.value))
          trial.message = "the quantities are not finite";
    }
    catch (const UserError &e)
    {
      trial.message = e.what();
      std::replace(trial.message.begin(), trial.message.end(), '\n', ' ');
    }
    trial.wall_seconds = elapsed() - start;
    return trials[levels] = std::move(trial);
  }

  std::string TrialRuns::warning_of_steps(const std::vector<std::string> &entries) const
  {
    if (file_parameters.check_steps == "no")
      return "";
    CaseRunner runner(file, overrides);
    runner.stop_if([this]() { return ask(); });
    std::vector<std::string> list = entries;
    list.emplace_back("Time/Check steps=yes");
    const std::string not_checked = "the motion as a whole was not checked: ";
    try
    {
      for (const Warning &warning : runner.run(list).warnings)
        if (warning.kind == "step")
          return "the motion as a whole is less accurate than these quantities: " + warning.message;
      if (const int signal = ask()) // it may have ended the check, after the run
        throw Interrupted(signal, "");
    }
    catch (const Interrupted &e)
    {
      if (e.signal() != SIGALRM)
        throw;
      return not_checked + "Study/Budget is over";
    }
    catch (const UserError &e)
    {
      return not_checked + e.what();
    }
    return "";
  }

  MeasuredRun TrialRuns::with_scheme(const Levels &levels, const std::string &scheme) const
  {
    std::vector<std::string> list = entries(levels);
    list.push_back("Time/Scheme=" + scheme);
    return run_once(list);
  }
} // namespace taut
