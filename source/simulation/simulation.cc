// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/results_folder.h"

#include "base/data_files.h"
#include "base/interruption.h"
#include "base/text.h"
#include "model/check_joints.h"
#include "model/contact_mass.h"
#include "model/form_finding.h"
#include "model/ranks_of_parts.h"
#include "model/scene_constraints.h"
#include "model/shared_parts.h"
#include "output/accuracy_report.h"
#include "output/contact_tables.h"
#include "output/jump_watch.h"
#include "output/model_limits.h"
#include "output/rest_figures.h"
#include "output/scene_report.h"
#include "partition/make_partition.h"
#include "time/unseen_feature.h"
#include <taut/base/exceptions.h>
#include <taut/output/fields.h>
#include <taut/output/impact_watch.h>
#include <taut/output/series.h>
#include <taut/output/slack_monitor.h>
#include <taut/simulation/checkpoints.h>
#include <taut/simulation/simulation.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <utility>

namespace taut
{
  namespace
  {
    /// Scene with all lengths, and with massless nodes if its contacts require them.
    Scene prepare_scene(const Parameters &parameters, const Communicator &processes,
                        SharedParts *const shared)
    {
      if (shared)
        shared->begin();
      Scene given = parameters.scene();
      distribute_bodies(given, parameters.partition, parameters.end_time / parameters.step,
                        processes);
      Scene scene =
          find_lengths(choose_slaves(std::move(given)), parameters.solver, processes, shared);
      if (parameters.chooses_contact_mass())
        redistribute_contact_mass(scene, parameters.solver, parameters.step);
      return scene;
    }
  } // namespace

  Simulation::Simulation(const Parameters &parameters, std::ostream &log,
                         const Communicator &processes, SharedParts *const shared)
      : parameters(parameters), log(log), processes(processes),
        model(prepare_scene(parameters, processes, shared)),
        bodies(model, with_own_cells(model, make_partition(model, choose_parts()), processes),
               processes, shared),
        grounded_links(check_held_ends(model, bodies)), links(make_constraints()),
        figures(parameters.statistics, model, links)
  {
    check_ball_joints(model, bodies);
  }

  Simulation::~Simulation() = default;

  Constraints Simulation::make_constraints() const
  {
    Constraints result = scene_constraints(model, bodies);
    choose_rows(result, parameters.solver.interface, bodies,
                !has_time() && model.start == Start::equilibrium);
    return result;
  }

  void Simulation::run()
  {
    const OutputParameters &output = parameters.output;
    FolderLock lock;
    const auto keep_folder = [&]
    {
      processes.agree(
          [&]
          {
            if (processes.is_root() && output.writes)
              lock.take(output.folder);
          });
    };
    if (output.writes)
      check_results_folder(parameters, processes);
    keep_folder();
    Checkpoints checkpoints(output.folder, output.checkpoint_interval, log, parameters.values(),
                            data_files(), bodies.n_sharing_ranks());
    if (output.resume)
      checkpoints.find(processes);
    describe();
    find_start();
    find_rest();
    stop_before_start();
    if (has_time())
      choose_scheme();
    if (has_time() && links.n_of_all() > 0)
      log << "Interface operator: " << motion->interface_description() << '\n';
    make_accuracy_report();
    stop_before_start();
    prepare_results(checkpoints.is_found());
    keep_folder(); // which may be new
    add_observers();
    if (has_time())
      observed->observe(checkpoints);
    observed->open();
    try
    {
      step_to_the_end();
    }
    catch (...)
    {
      // Results before the error are kept; they may show the reason. A second error says less than
      // the first. Other ranks may have ended.
      try
      {
        finish(true);
        observed->report(log, true);
      }
      catch (const std::exception &)
      {
      }
      throw;
    }
    processes.agree([&] { finish(observed->signal() != 0); });
    observed->report(log);
    log << "Results in " << output.folder << '\n';
    say_how_it_ended();
  }

  void Simulation::check()
  {
    print_scene(model, places_in_space(model, bodies), log);
    describe();
    find_start();
    stop_before_start();
    if (has_time())
      choose_scheme();
    log << "The scene is consistent\n";
  }

  /// Number of steps within the time of the run, for which the checks hold.
  long Simulation::n_steps() const
  {
    constexpr double rounding = 1e-9;
    return static_cast<long>(
        std::floor(parameters.end_time / parameters.step * (1. + rounding) + rounding));
  }

  int Simulation::signal() const
  {
    return static_cast<int>(processes.max(stop_asked ? stop_asked() : 0));
  }

  void Simulation::stop_before_start() const
  {
    if (const int stop = signal())
      throw Interrupted(stop, "ended by " + signal_name(stop) +
                                  " before the first step; nothing was written");
  }

  /// Prepares the steps; the first factorisation finds unsupported bodies.
  void Simulation::choose_scheme()
  {
    std::vector<std::size_t> massless;
    for (std::size_t i = 0; i < links.size(); ++i)
      if (links[i].is_link() && is_massless(model.links[links[i].link]))
        massless.push_back(i);
    if (const std::vector<std::size_t> all = links.numbers_of(massless); !all.empty())
      log << "Mass redistribution: nodes of wires under " << links.names(all)
          << " gave their mass to their neighbours\n";
    motion->choose_scheme();
    log << (motion->choice().reason.empty() ? "Scheme: " : "Scheme (automatic): ")
        << motion->scheme_and_reason() << '\n';
    for (const std::string &entry : unused_scheme_entries())
      log << "  not used by it: " << entry << '\n';
    motion->prepare(n_steps());
  }

  std::vector<std::string> Simulation::unused_scheme_entries() const
  {
    return parameters.unused_scheme_entries(motion->choice().name, motion->choice().entries);
  }

  /// Steps that do not see all of the scene are compared with others only if these do.
  void Simulation::make_accuracy_report()
  {
    std::vector<Warning> unseen;
    if (has_time())
      unseen = unseen_features();
    std::string reason;
    std::unique_ptr<StepAccuracy> steps;
    RunInSteps run = {*motion, n_steps(), parameters.check_steps == "yes", warning_of_joints(model),
                      unseen.empty() ? std::numeric_limits<double>::infinity()
                      : motion->unseen_feature().is_all_seen ? unseen.front().limit
                                                             : 0.};
    if (!unseen.empty() && !StepAccuracy::sees_more(run))
      reason = "something lies between them, and steps that see it take long";
    else if (parameters.check_steps == "automatic" && parameters.scheme != "automatic")
      reason = "the Scheme is given by name: set Time/Check steps = yes for it";
    else if (parameters.check_steps == "automatic" && n_steps() > 0 &&
             !StepAccuracy::is_affordable(run))
      reason = "runs with other steps take long: set Time/Check steps = yes for them";
    else if (parameters.check_steps == "no")
      reason = "Time/Check steps = no";
    else if (n_steps() > 0)
      steps = std::make_unique<StepAccuracy>(std::move(run));
    accuracy = std::make_unique<AccuracyReport>(motion->measures(), std::move(steps),
                                                n_steps() > 0 ? reason : "", unseen);
  }

  /// What lies between the steps, as a warning.
  std::vector<Warning> Simulation::unseen_features() const
  {
    const UnseenFeature &narrowest = motion->unseen_feature(),
                        &feature = narrowest.local ? *narrowest.local : narrowest;
    const StepParameters &control = motion->settings().steps;
    const double shortest = control.shortest(parameters.step);
    if (feature.name.empty() || (shortest <= feature.longest_step && !narrowest.local))
      return {};
    std::string message =
        to_text(std::setprecision(2), feature.name, " changes for about ", feature.width,
                " s at t = ", std::setprecision(4), feature.time, " s, ", std::setprecision(2));
    if (!control.adaptive())
      message += to_text("which steps of ", parameters.step,
                         " s do not see, or make too much of. Take a step of at most ",
                         feature.longest_step, " s",
                         feature.is_local ? "" : ", or Step control = adaptive");
    else if (narrowest.local)
      message +=
          to_text("on a part of the body, which adaptive steps do not see. Take Step control "
                  "= fixed with a Step of at most ",
                  feature.longest_step, " s");
    else
      message += to_text("and the shortest step is ", shortest, " s. Set Adaptive step/Halvings = ",
                         std::ceil(std::log2(parameters.step / feature.longest_step)));
    return {{"feature", message, shortest, feature.longest_step, "s", feature.time}};
  }

  std::string Simulation::what_steps_miss() const
  {
    const std::vector<Warning> unseen = unseen_features();
    return unseen.empty() ? "" : unseen.front().message;
  }

  /// Called once the scene is known to be valid: before this, the disk is not touched.
  void Simulation::prepare_results(const bool resumes)
  {
    BodyVectors at_start = motion->reference().displacement;
    for (std::size_t k = 0; k < at_start.size(); ++k)
      for (std::size_t i = 0; i < at_start[k].size(); ++i)
        at_start[k][i] += motion->start().state.U[k][i];
    const ScenePlaces places = places_in_space(model, bodies, &at_start);
    const std::vector<double> heights = heights_at_rest();
    const State &start = motion->start().state;
    const std::vector<double> forces = links.of_links(start.multiplier, model.links.size()),
                              gaps = links.of_links(start.distance, model.links.size());
    processes.agree(
        [&]
        {
          if (!processes.is_root() || resumes || !parameters.output.writes)
            return;
          std::vector<std::string> comments;
          if (has_time())
            comments.push_back("The scheme was " + motion->scheme() + ".");
          for (const std::string &entry : parameters.unused_entries())
            comments.push_back("Not used: " + entry);
          if (has_time())
            for (const std::string &entry : unused_scheme_entries())
              comments.push_back("Not used by it: " + entry);
          prepare_folder(parameters, comments);
          if (!model.links.empty())
            write_start(places, heights, forces, gaps);
        });
  }

  /// Adds observers of results, of the caller and of the model, in the order of their reports.
  void Simulation::add_observers()
  {
    const OutputParameters &output = parameters.output;
    if (has_time())
    {
      observed->observe(figures);
      observed->observe(*accuracy);
    }
    const TableFormat format = output.tables == "binary" ? TableFormat::binary : TableFormat::csv;
    if (output.writes)
      observed->observe(has_time()
                            ? std::make_unique<Series>(model, links, format, output.link_interval,
                                                       output.tables == "long")
                            : std::make_unique<Series>(model));
    for (Observer *guest : guests)
      observed->observe(*guest);
    for (const std::string &name : output.observers)
      observed->observe(parameters.make_observer(name));
    const ContactTables *contacts = nullptr;
    if (output.writes && !model.contacts.empty())
    {
      auto tables = std::make_unique<ContactTables>(model, output.field_interval);
      contacts = tables.get();
      observed->observe(std::move(tables));
    }
    if (!has_time())
    {
      at_rest = std::make_unique<RestFigures>(model, contacts);
      observed->observe(*at_rest);
    }
    observed->observe(std::make_unique<Fields>(output.folder, model, bodies, output.field_interval,
                                               output.subdivisions));
    observed->observe(std::make_unique<SlackMonitor>());
    if (has_time())
    {
      observed->observe(std::make_unique<ImpactWatch>());
      observed->observe(std::make_unique<JumpWatch>());
    }
    // At least a hundred times in a run, and too seldom to cost time.
    limits = std::make_unique<ModelLimits>(
        model, bodies, has_time() ? parameters.statistics.filter_frequency : 0., parameters.step,
        has_time() ? std::clamp(n_steps() / 100, 1L, 50L) : 1L);
    observed->observe(*limits);
  }

  std::vector<NamedQuantity> Simulation::observed_quantities() const
  {
    if (observed)
      return measured;
    std::vector<NamedQuantity> all;
    const auto append = [&](const Observer &observer)
    {
      const std::vector<NamedQuantity> own = observer.quantities();
      all.insert(all.end(), own.begin(), own.end());
    };
    for (const Observer *guest : guests)
      append(*guest);
    for (const std::string &name : parameters.output.observers)
      append(*parameters.make_observer(name));
    return all;
  }

  void Simulation::step_to_the_end()
  {
    observed->begin();
    while (!observed->is_over())
      observed->advance();
    if (has_time() && motion->start().repeated_joints.empty())
      report_repeated_joints(links.names(motion->repeated_joints()));
    if (motion->n_repeated() > 0)
      log << motion->n_repeated() << " steps were repeated with a shorter one\n";
    motion->discard_factors(); // before the check makes its own
    if (observed->signal() == 0)
      accuracy->check_steps([this] { return signal() != 0; });
  }

  void Simulation::finish(const bool is_partial)
  {
    observed->finish();
    measured = observed->quantities();
    if (is_partial)
      log << "Partial results: until t = " << figures.until() << " s of " << parameters.end_time
          << " s\n";
    const std::string file = parameters.output.folder + "/statistics.json";
    if (!processes.is_root() || !parameters.output.writes)
      return;
    if (!has_time())
      at_rest->write(file, description(is_partial), observed_quantities());
    else
    {
      figures.write(file, description(is_partial), observed_quantities());
      figures.write_tables(parameters.output.folder);
    }
  }

  std::vector<Warning> Simulation::warnings() const
  {
    std::vector<Warning> all;
    if (limits)
      all = limits->warnings();
    const std::vector<Warning> others = accuracy ? accuracy->warnings() : std::vector<Warning>();
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }

  RunDescription Simulation::description(const bool is_partial) const
  {
    return {parameters.file_name(),
            parameters.generator_name,
            motion->scheme(),
            parameters.step,
            n_steps() * parameters.step,
            is_partial,
            warnings()};
  }

  /// Throws after a request to stop, or for wrong energies.
  void Simulation::say_how_it_ended() const
  {
    if (const int signal = observed->signal())
      throw Interrupted(
          signal,
          to_text("ended by ", signal_name(signal), " after the step at t = ", figures.until(),
                  " s of ", parameters.end_time, " s; the results until then are in ",
                  parameters.output.folder,
                  parameters.output.checkpoint_interval > 0. ? "; go on with --resume" : ""));
    const std::string error = motion->measures().error();
    if (!error.empty() && !parameters.allow_energy_gain)
      throw EntryError(motion->measures().error_origin(), error);
  }
} // namespace taut
