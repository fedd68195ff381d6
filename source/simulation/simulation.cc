// SPDX-License-Identifier: LGPL-2.1-or-later
#include "observer_list.h"
#include "results_folder.h"

#include <taut/base/exceptions.h>
#include <taut/base/interruption.h>
#include <taut/base/memory.h>
#include <taut/model/check_joints.h>
#include <taut/model/contact_mass.h>
#include <taut/model/form_finding.h>
#include <taut/model/scene_constraints.h>
#include <taut/model/shared_parts.h>
#include <taut/output/contact_tables.h>
#include <taut/output/fields.h>
#include <taut/output/impact_watch.h>
#include <taut/output/scene_report.h>
#include <taut/output/series.h>
#include <taut/output/slack_monitor.h>
#include <taut/partition/make_partition.h>
#include <taut/scene/entries.h>
#include <taut/simulation/simulation.h>
#include <taut/time/choose_scheme.h>
#include <taut/time/step_accuracy.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <ostream>
#include <sstream>

namespace taut
{
  namespace
  {
    /// The scene with all lengths, and nodes without mass where the contacts ask for that.
    Scene prepare_scene(const Parameters &parameters, SharedParts *const shared)
    {
      if (shared)
        shared->begin();
      Scene scene = find_lengths(choose_slaves(parameters.scene()), parameters.solver, shared);
      if (parameters.chooses_contact_mass())
        redistribute_contact_mass(scene, parameters.solver, parameters.step);
      return scene;
    }
  } // namespace

  Simulation::Simulation(const Parameters &parameters, std::ostream &log,
                         const Communicator &processes, SharedParts *const shared)
      : parameters(parameters), log(log), processes(processes),
        model(prepare_scene(parameters, shared)),
        bodies(model, make_partition(model, choose_parts()), processes, shared),
        grounded_links(check_held_ends(model, bodies)), links(scene_constraints(model, bodies)),
        reactions(model, bodies), figures(parameters.statistics, model, links)
  {
    check_ball_joints(model, bodies);
    for (const Probe &probe : model.probes)
    {
      probe_terms.emplace_back();
      bodies.motion(probe.point, probe.rotational, probe.direction, 1., probe_terms.back());
    }
    probe_rest.assign(probe_terms.size(), 0.);
    probe_values.assign(probe_terms.size(), 0.);
  }

  Simulation::~Simulation() = default;

  void Simulation::run()
  {
    if (parameters.output.writes)
      check_results_folder(parameters, processes);
    find_checkpoint();
    describe();
    find_start();
    find_rest_of_probes();
    measures = std::make_unique<ContactMeasures>(bodies, links, reference, start);
    reactions.update_start(reference, start, links);
    stop_before_start();
    const TimeIntegrator *integrator = parameters.end_time > 0. ? &choose_integrator() : nullptr;
    measures->set_scheme(parameters.scheme == "automatic", parameters.step_parameters.adaptive());

    // The first factorisation, which finds the bodies that nothing holds.
    std::unique_ptr<TimeStepper> time_stepper;
    if (integrator)
      time_stepper = std::make_unique<TimeStepper>(bodies, links, parameters.solver, *integrator,
                                                   parameters.step, reference, start,
                                                   model.start == Start::equilibrium);
    if (time_stepper && links.size() > 0)
      log << "Interface operator: " << time_stepper->interface_description() << '\n';

    if (integrator)
      prepare_step_check(*integrator);
    stop_before_start();
    BodyVectors at_start = reference.displacement;
    for (std::size_t k = 0; k < at_start.size(); ++k)
      for (std::size_t i = 0; i < at_start[k].size(); ++i)
        at_start[k][i] += start.U[k][i];
    const ScenePlaces places = places_in_space(model, bodies, &at_start);
    // Nothing on the disk was touched until here, where the scene is known to make sense.
    on_root(
        [&]
        {
          if (checkpoint || !parameters.output.writes)
            return;
          std::vector<std::string> comments;
          if (!scheme.empty())
            comments.push_back("The scheme was " + scheme + ".");
          for (const std::string &entry : parameters.unused_entries())
            comments.push_back("Not used: " + entry);
          for (const std::string &entry : unused_entries)
            comments.push_back("Not used by it: " + entry);
          prepare_folder(parameters, comments);
          write_start(places);
        });
    // At least a hundred times a run, and too seldom to be felt.
    limits = std::make_unique<ModelLimits>(
        model, bodies, integrator ? parameters.statistics.filter_frequency : 0., parameters.step,
        integrator ? std::clamp(n_steps() / 100, 1L, 50L) : 1L);
    Fields fields(parameters.output.folder, model, bodies, parameters.output.field_interval,
                  parameters.output.subdivisions);
    ObserverList observers(processes);
    SlackMonitor slack;
    ImpactWatch impacts;
    const RunView run_view = {parameters.output.folder, parameters.output.interval, processes,
                              checkpoint != nullptr};
    if (!integrator)
    {
      add_guests(observers);
      observers.add(&fields);
      observers.add(&slack);
      observers.begin(run_view);
      show(observers, start, start_certificate);
      on_root(
          [&]
          {
            if (parameters.output.writes)
              write_probes(parameters.output.folder, model, probe_values);
          });
      processes.agree([&] { observers.finish(); });
      slack.print(log);
      limits->print(log);
      log << "Results in " << parameters.output.folder << '\n';
      return;
    }

    TimeStepper &stepper = *time_stepper;
    std::unique_ptr<Series> series;
    on_root(
        [&]
        {
          if (!parameters.output.writes)
            return;
          const TableFormat format =
              parameters.output.tables == "binary" ? TableFormat::binary : TableFormat::csv;
          series = std::make_unique<Series>(parameters.output.folder, model, links, format,
                                            parameters.output.interval,
                                            parameters.output.link_interval, checkpoint != nullptr);
        });
    observers.add(&figures);
    observers.add(series.get());
    add_guests(observers);
    observers.add(&fields);
    observers.add(&slack);
    observers.add(&impacts);
    observers.begin(run_view);
    if (parameters.output.checkpoint_interval > 0. && !checkpoint)
      observers.save(); // one that cannot says so before the first step

    const auto close = [&](const bool is_partial)
    {
      observers.finish();
      if (is_partial)
        log << "Partial results: until t = " << figures.until() << " s of " << parameters.end_time
            << " s\n";
      if (!processes.is_root() || !parameters.output.writes)
        return;
      figures.write(parameters.output.folder + "/statistics.json", description(is_partial));
    };
    const auto begin = std::chrono::steady_clock::now();
    try
    {
      advance(stepper, observers);
      check_steps();
    }
    catch (...)
    {
      // What was computed before the error is kept; it may show the reason. An error that comes of
      // it says less than the first. Other ranks may not be here.
      try
      {
        close(true);
        figures.print(log);
        if (processes.size() == 1)
          slack.print(log);
        impacts.print(log);
        limits->print(log);
      }
      catch (const std::exception &)
      {
      }
      throw;
    }
    const double all =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    processes.agree(
        [&]
        {
          close(stop_signal != 0);
          check_memory();
        });
    figures.print(log);
    log << measures->report();
    if (accuracy)
      log << accuracy->report();
    slack.print(log);
    impacts.print(log);
    limits->print(log);
    print_cost(stepper, figures.until(), all);
    log << "Results in " << parameters.output.folder << '\n';
    if (stop_signal != 0)
    {
      std::ostringstream message;
      message << "ended by " << signal_name(stop_signal)
              << " after the step at t = " << figures.until() << " s of " << parameters.end_time
              << " s; the results until then are in " << parameters.output.folder;
      if (parameters.output.checkpoint_interval > 0.)
        message << "; go on with --resume";
      throw Interrupted(stop_signal, message.str());
    }
    const std::string error = measures->error();
    if (!error.empty() && !parameters.allow_energy_gain)
      throw EntryError(measures->error_origin(), error);
  }

  void Simulation::stop_before_start()
  {
    stop_signal = static_cast<int>(processes.max(stop_asked ? stop_asked() : 0));
    if (stop_signal != 0)
      throw Interrupted(stop_signal, "ended by " + signal_name(stop_signal) +
                                         " before the first step; nothing was written");
  }

  void Simulation::check()
  {
    print_scene(model, places_in_space(model, bodies), log);
    describe();
    find_start();
    stop_before_start();
    if (parameters.end_time > 0.)
      TimeStepper(bodies, links, parameters.solver, choose_integrator(), parameters.step, reference,
                  start, model.start == Start::equilibrium);
    log << "The scene is consistent\n";
  }

  void Simulation::on_root(const std::function<void()> &work) const
  {
    processes.agree(
        [&]
        {
          check_memory();
          if (processes.is_root())
            work();
        });
  }

  void Simulation::add_guests(ObserverList &observers) const
  {
    for (Observer *guest : guests)
      observers.add(guest);
    for (const std::string &name : parameters.output.observers)
      observers.add(parameters.make_observer(name));
    if (!model.contacts.empty())
      observers.add(std::make_unique<ContactTables>(model, parameters.output.field_interval));
  }

  void Simulation::show(const ObserverList &observers, const State &state,
                        const Certificate &certificate)
  {
    update_probes(state);
    if (&state != &start)
      reactions.update(reference, state, links, coefficients);
    observers.record(view(state, certificate));
    limits->record(view(state, certificate));
  }

  void Simulation::advance(TimeStepper &stepper, const ObserverList &observers)
  {
    StepControl control(parameters.step_parameters, parameters.step, n_steps(),
                        !stepper.is_linear(), longest_steps);
    if (checkpoint)
      resume(stepper, control, observers);
    else
      show(observers, start, start_certificate);
    while (!control.is_finished() && stop_signal == 0)
    {
      const auto before = std::chrono::steady_clock::now();
      control.advance(stepper);
      if (!parameters.allow_unsuitable_scheme)
        stepper.check_moving_contacts();
      coefficients = stepper.scheme();
      measures->record(stepper.state(), coefficients, stepper.certificate());
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
      if (accuracy)
        accuracy->record(stepper.state());
      show(observers, stepper.state(), stepper.certificate());
      save_checkpoint(stepper, control, observers);
    }
    if (control.is_finished())
      stop_signal = 0; // it came too late to matter
    if (control.n_repeated() > 0)
      log << control.n_repeated() << " steps were repeated with a shorter one\n";
  }

  /// The steps that fit into the time of the run: what was checked up to its end stays true.
  long Simulation::n_steps() const
  {
    constexpr double rounding = 1e-9;
    return static_cast<long>(
        std::floor(parameters.end_time / parameters.step * (1. + rounding) + rounding));
  }

  const TimeIntegrator &Simulation::choose_integrator()
  {
    const double step = parameters.step_parameters.longest(parameters.step);
    std::vector<std::size_t> massless;
    for (std::size_t i = 0; i < links.size(); ++i)
      if (links[i].is_link() && is_massless(model.links[links[i].link]))
        massless.push_back(i);
    if (!massless.empty())
      log << "Mass redistribution: nodes of wires under " << links.names(massless)
          << " gave their mass to their neighbours\n";
    // Made where it is needed only: its factors may be lost in rounding where the run's are not.
    std::optional<ContactResolution> made;
    const auto resolution = [&]() -> const ContactResolution &
    {
      if (!made)
        made.emplace(bodies, links, parameters.solver, parameters.step, step, parameters.end_time);
      return *made;
    };
    std::string name = parameters.scheme;
    std::map<std::string, std::string> entries;
    std::string reason;
    if (name == "automatic")
    {
      const SchemeChoice choice =
          choose_scheme(bodies, links, resolution(), parameters.restitution());
      name = choice.name;
      entries = choice.entries;
      reason = ", because " + choice.reason;
    }
    chosen_integrator = parameters.integrator(name, entries);
    const TimeIntegrator &integrator = *chosen_integrator;
    log << (reason.empty() ? "Scheme: " : "Scheme (automatic): ") << integrator.description()
        << reason << '\n';
    check_mass(integrator, bodies, step);
    keep_scheme(integrator, parameters.unused_scheme_entries(name, entries));
    if (reason.empty() && !parameters.allow_unsuitable_scheme)
      check_scheme(integrator, bodies, links, resolution, parameters.solver, step);
    if (integrator.coefficients(step).velocity_projection)
    {
      links.set_conserving(resolution().conserving());
      longest_steps = resolution().longest_steps();
    }
    return integrator;
  }

  void Simulation::keep_scheme(const TimeIntegrator &integrator, std::vector<std::string> unused)
  {
    scheme = integrator.description();
    unused_entries = std::move(unused);
    for (const std::string &entry : unused_entries)
      log << "  not used by it: " << entry << '\n';
  }

  StepView Simulation::view(const State &state, const Certificate &certificate) const
  {
    return {model,       bodies,       links,     reference,    state,
            certificate, coefficients, *measures, probe_values, reactions.forces()};
  }

  void Simulation::update_probes(const State &state)
  {
    for (std::size_t i = 0; i < probe_terms.size(); ++i)
      probe_values[i] =
          evaluate(probe_terms[i], reference.displacement) + evaluate(probe_terms[i], state.U);
    // Whether to stop goes with them: one message for both, and all ranks stop at the same step.
    const int asked = stop_asked ? stop_asked() : 0;
    probe_values.push_back(asked);
    processes.sum(probe_values);
    if (probe_values.back() > 0.)
      stop_signal = static_cast<int>(processes.max(asked));
    probe_values.pop_back();
    for (std::size_t i = 0; i < probe_terms.size(); ++i)
      probe_values[i] -= probe_rest[i];
  }
} // namespace taut
