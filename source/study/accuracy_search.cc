// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/accuracy_search.h"
#include "base/interruption.h"
#include "base/text.h"
#include "study/study_report.h"
#include <taut/base/exceptions.h>
#include <taut/output/table_file.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <ostream>

namespace taut
{
  namespace
  {
    /// Levels as sizes: settings compare by them where a mesh has a count, too.
    std::vector<std::string> sizes(const std::vector<int> &levels)
    {
      std::vector<std::string> values;
      for (const int level : levels)
        values.push_back(csv_number(std::ldexp(1., -level)));
      return values;
    }
  } // namespace

  AccuracySearch::AccuracySearch(const std::string &file, const std::vector<std::string> &overrides,
                                 const double accuracy, const bool overwrite, std::ostream &log)
      : accuracy(accuracy), overwrite(overwrite), log(log), runs(file, overrides)
  {
    if (!(accuracy > 0. && accuracy < 1.))
      throw UserError("--accuracy is a relative error between 0 and 1, such as 0.01");
    for (const Refinement &refinement : runs.refinements())
      for (const Refinement::Group &group : refinement.groups)
        study.parameter_lists.push_back({group.name, group.entries, {}, "", false});
    study.end_time = runs.parameters().end_time;
  }

  const StudySetting &AccuracySearch::run()
  {
    try
    {
      prepare_study_folder(runs.parameters().study_folder(), overwrite);
      runs.name_quantities();
      check_quantities(runs.parameters());
      study.quantity_names = runs.parameters().study.quantities.names;
      const StudySetting &best = search();
      keep_results();
      report(best);
      return best;
    }
    catch (const EntryError &e)
    {
      throw UserError(runs.parameters().explain(e));
    }
    catch (const Interrupted &e)
    {
      if (e.signal() == SIGALRM)
        throw no_estimate(
            to_text("Study/Budget of ", runs.parameters().study.budget, " s is over"));
      throw Interrupted(e.signal(), "search ended by " + signal_name(e.signal()) +
                                        " before an accuracy was found");
    }
  }

  const StudySetting &AccuracySearch::search()
  {
    // Levels finer than the file; more if steps do not see all of the scene.
    constexpr int most_for_features = 12;
    int most_finer = 4;
    const std::vector<Refinement> &refinements = runs.refinements();
    Levels centre(refinements.size(), 1);
    const auto is_fine_enough = [&]()
    {
      for (std::size_t d = 0; d < refinements.size(); ++d)
        if (centre[d] >= refinements[d].n_coarser + most_finer)
          return true;
      return false;
    };
    while (!is_fine_enough())
    {
      if (!star_runs(centre))
      {
        if (misses_something && most_finer < most_for_features)
        {
          ++most_finer;
          ++centre[0];
          continue;
        }
        for (int &level : centre)
          ++level;
        continue;
      }
      estimate(centre);
      rate_settings();
      if (cheapest(study.settings, accuracy))
      {
        ask_second_scheme(centre);
        rate_settings();
      }
      if (cheapest(study.settings, accuracy) && look_far(centre))
        rate_settings();
      if (const StudySetting *best = cheapest(study.settings, accuracy))
        return *best;
      ++centre[std::max_element(changes.begin(), changes.end()) - changes.begin()];
    }
    throw no_estimate("step or elements are sixteen times as fine as in the file");
  }

  /// Whether the centre and its neighbours along each refinement run.
  bool AccuracySearch::star_runs(const Levels &centre)
  {
    for (std::size_t d = 0; d < centre.size(); ++d)
      for (const int move : {-1, 0, 1})
      {
        Levels levels = centre;
        levels[d] += move;
        const TrialRuns::Trial &trial = runs.at(levels);
        if (!trial.message.empty())
        {
          failure = trial.message;
          misses_something = !trial.run.unseen.empty();
          return false;
        }
      }
    failure.clear();
    return true;
  }

  /// The converged quantities: the corrections of all refinements add up.
  void AccuracySearch::estimate(const Levels &centre)
  {
    const std::size_t n = study.quantity_names.size(), n_refinements = centre.size();
    study.references.assign(n, {});
    step_limits.clear();
    std::vector<std::vector<double>> change(n_refinements, std::vector<double>(n));
    for (std::size_t i = 0; i < n; ++i)
    {
      const StudyQuantity own = runs.at(centre).run.quantities[i];
      QuantityReference &reference = study.references[i];
      reference.quantity = own;
      for (std::size_t d = 0; d < n_refinements; ++d)
      {
        std::vector<StudyQuantity> line;
        Levels levels = centre;
        for (levels[d] = centre[d] - 1; levels[d] <= centre[d] + 1; ++levels[d])
          line.push_back(runs.at(levels).run.quantities[i]);
        const QuantityReference limit = extrapolate(line);
        change[d][i] = distance(own, limit.quantity) + limit.error;
        // Histories are not corrected, so that the correction is part of the error.
        reference.error += own.is_history() ? change[d][i] : limit.error;
        if (!own.is_history())
          reference.quantity.value += limit.quantity.value - own.value;
        if (d == 0)
        {
          reference.order = limit.order;
          step_limits.push_back(limit);
        }
      }
    }
    find_scales();
    changes.assign(n_refinements, 0.);
    for (std::size_t d = 0; d < n_refinements; ++d)
      for (std::size_t i = 0; i < n; ++i)
        changes[d] = std::max(changes[d], change[d][i] / study.references[i].scale);
  }

  void AccuracySearch::find_scales()
  {
    const auto &quantities = runs.parameters().study.quantities;
    for (std::size_t i = 0; i < study.references.size(); ++i)
    {
      QuantityReference &reference = study.references[i];
      const double given = quantities.items[i].scale;
      reference.scale = given > 0. ? given : std::fabs(reference.quantity.value);
      if (!(reference.scale > 0.))
        throw EntryError(quantities.title(i) + "/Scale",
                         "the quantity is 0: give a scale for its errors");
    }
  }

  /// The errors of all settings that ran, against the present references.
  void AccuracySearch::rate_settings()
  {
    study.settings.clear();
    for (const auto &[levels, trial] : runs.all())
    {
      StudySetting setting;
      setting.values = sizes(levels);
      setting.message = trial.message;
      setting.seconds = {trial.run.seconds};
      setting.seconds_with_output = trial.wall_seconds;
      for (const auto &[other, coarser] : runs.all())
        if (coarser.message.empty() &&
            std::equal(other.begin(), other.end(), levels.begin(), std::less_equal<int>()))
          setting.coarser_seconds = std::max(setting.coarser_seconds, coarser.run.seconds);
      setting.certificate = trial.run.certificate;
      setting.n_steps = trial.run.n_steps;
      for (std::size_t i = 0; i < trial.run.quantities.size(); ++i)
      {
        const StudyQuantity &quantity = trial.run.quantities[i];
        const QuantityReference &reference = study.references[i];
        setting.quantities.push_back(quantity.value);
        setting.errors.push_back(distance(quantity, reference.quantity) / reference.scale);
        setting.error = std::max(setting.error, setting.errors[i]);
        setting.reference_error =
            std::max(setting.reference_error, reference.error / reference.scale);
      }
      study.settings.push_back(std::move(setting));
    }
    const ParameterList refined{"", {}, {}, "", true};
    find_bounds(std::vector<ParameterList>(runs.refinements().size(), refined), study.settings);
  }

  /**
   * Adds to the errors of the references what a second scheme is away from them. With steps that
   * get shorter it comes to the same limit. So the distance of its second run is at most the change
   * between its runs, for orders of one and more.
   */
  void AccuracySearch::ask_second_scheme(const Levels &centre)
  {
    Levels coarser = centre;
    --coarser[0];
    second_scheme.clear();
    for (const std::string scheme : {"BDF2", "generalised-alpha", "Moreau-Jean"})
      if (scheme != runs.parameters().scheme && second_scheme.empty())
        try
        {
          const MeasuredRun first = runs.with_scheme(coarser, scheme),
                            second = runs.with_scheme(centre, scheme);
          second_scheme = scheme;
          for (std::size_t i = 0; i < study.references.size(); ++i)
          {
            const double change = distance(second.quantities[i], first.quantities[i]),
                         away = distance(second.quantities[i], step_limits[i].quantity);
            QuantityReference &reference = study.references[i];
            reference.error += std::max(0., away - change - reference.error);
          }
        }
        catch (const UserError &) // the scheme suits no such contacts
        {
        }
  }

  /**
   * Makes a run with an eighth of the step of the centre, where Study/Budget has time for it. All
   * runs of a star may miss the same impact and agree. As the error of a setting is at least that
   * of all finer ones, those that miss it then have its distance. False: there is no such run.
   */
  bool AccuracySearch::look_far(const Levels &centre)
  {
    constexpr int levels_away = 3;
    constexpr double times_finest = 4., margin = 2.; // its run over the finest of the star
    Levels levels = centre;
    ++levels[0];
    const double seconds = times_finest * runs.at(levels).wall_seconds;
    if (runs.elapsed() + margin * seconds > runs.parameters().study.budget)
      return false;
    levels[0] = centre[0] + levels_away;
    return runs.at(levels).message.empty();
  }

  void AccuracySearch::keep_results()
  {
    std::size_t i = 0;
    for (const auto &[levels, trial] : runs.all())
    {
      std::vector<std::string> &values = study.settings[i++].values;
      values.clear();
      for (std::size_t d = 0; d < levels.size(); ++d)
        for (const std::string &value : runs.refinements()[d].values(levels[d]))
        {
          std::vector<std::string> &list = study.parameter_lists[values.size()].values;
          if (std::count(list.begin(), list.end(), value) == 0)
            list.push_back(value);
          values.push_back(value);
        }
    }
    find_front(study.settings);
    const std::string folder = runs.parameters().study_folder();
    write_work_precision(study, folder + "/work_precision.csv");
    write_study(study, runs.parameters().values(), folder + "/study.json");
  }

  void AccuracySearch::report(const StudySetting &best) const
  {
    log << "Setting for an error of at most " << accuracy << ": ";
    for (std::size_t k = 0; k < best.values.size(); ++k)
      log << (k > 0 ? ", " : "") << study.parameter_lists[k].name << " = " << best.values[k];
    log << "\n  expected error " << best.bound + best.reference_error << ", run of "
        << best.seconds_with_output << " s, " << study.end_time / best.least_seconds()
        << " x real time\n";
    for (std::size_t i = 0; i < best.quantities.size(); ++i)
      log << "  " << study.quantity_names[i] << " = " << best.quantities[i] << ", expected error "
          << best.bounds[i] + study.references[i].error / study.references[i].scale << '\n';
    std::vector<std::string> entries;
    for (std::size_t k = 0; k < best.values.size(); ++k)
      for (const std::string &entry : study.parameter_lists[k].entries)
        entries.push_back(entry + "=" + best.values[k]);
    if (const std::string warning = runs.warning_of_steps(entries); !warning.empty())
      log << "  " << warning << '\n';
    log << "  checked by "
        << (second_scheme.empty() ? "no second scheme: none suits the contacts" : second_scheme)
        << "\nThe search took " << study.settings.size() << " runs and " << runs.elapsed() << " s, "
        << runs.elapsed() / best.seconds_with_output << " times that of the setting\n"
        << "Study in " << runs.parameters().study_folder() << ", Study/Accuracy = " << accuracy
        << " takes it\n";
  }

  UserError AccuracySearch::no_estimate(const std::string &reason) const
  {
    std::string worst;
    double largest = 0.;
    for (std::size_t i = 0; i < study.references.size(); ++i)
      if (study.references[i].error / study.references[i].scale > largest)
      {
        largest = study.references[i].error / study.references[i].scale;
        worst = "; '" + study.quantity_names[i] + "' is the least certain";
      }
    return UserError(to_text("no setting is known to have an error of at most ", accuracy, ": ",
                             reason, worst, failure.empty() ? "" : "; a run failed: ", failure,
                             "; ask for less accuracy, allow more Study/Budget, or name other "
                             "Study/Quantities"));
  }
} // namespace taut
