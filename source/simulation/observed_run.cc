// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/schur_complement.h"
#include "output/reactions.h"
#include <taut/base/archive.h>
#include <taut/simulation/checkpoints.h>
#include <taut/simulation/observed_run.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <ostream>
#include <sstream>
#include <string>

namespace taut
{
  ObservedRun::ObservedRun(Stepper &stepper, const std::string &folder, const double interval)
      : own_scene(std::make_unique<Scene>()),
        own_bodies(std::make_unique<SceneBodies>(stepper.stepped().bodies())),
        motion(stepper.stepped()), named(*own_scene), bodies(*own_bodies), folder(folder),
        interval(interval), reactions(std::make_unique<Reactions>(named, bodies))
  {
    for (const Structure::Body &body : bodies.all_bodies())
      own_scene->bodies.push_back({body.name, "", "", nullptr});
  }

  ObservedRun::ObservedRun(Motion &motion, const Scene &scene, const SceneBodies &structure,
                           const std::string &folder, const double interval)
      : motion(motion), named(scene), bodies(structure), folder(folder), interval(interval),
        reactions(std::make_unique<Reactions>(scene, structure))
  {
    for (const Probe &probe : scene.probes)
    {
      probe_terms.emplace_back();
      bodies.motion(probe.point, probe.rotational, probe.direction, 1., probe_terms.back());
    }
    probe_rest.assign(probe_terms.size(), 0.);
    probe_values = probe_rest;
    reactions->update_start(motion.reference(), motion.start().state, motion.links());
  }

  ObservedRun::~ObservedRun() = default;

  void ObservedRun::add_probe(const std::string &name, const Displacement &form,
                              const bool rotational)
  {
    if (!own_scene)
      throw UserError("probe '" + name + "': the probes of a scene are part of it");
    Probe probe;
    probe.name = name;
    probe.rotational = rotational;
    own_scene->probes.push_back(probe);
    probe_terms.push_back(form);
    probe_values.assign(probe_terms.size(), 0.);
    set_rest_of_probes(motion.reference().displacement);
  }

  void ObservedRun::set_rest_of_probes(const BodyVectors &rest)
  {
    probe_rest.clear();
    for (std::size_t i = 0; i < probe_terms.size(); ++i)
      probe_rest.push_back(named.probes[i].quantity == Probe::Quantity::displacement
                               ? evaluate(probe_terms[i], rest)
                               : 0.);
    processes().sum(probe_rest);
  }

  void ObservedRun::observe(std::unique_ptr<Observer> observer)
  {
    observe(*observer);
    owned.push_back(std::move(observer));
  }

  void ObservedRun::observe(Checkpoints &last)
  {
    checkpoints = &last;
    checkpoints->set_run(*this);
  }

  /// An exception of one rank is thrown on all.
  template <typename Call>
  void ObservedRun::each(const Call &call) const
  {
    for (Observer *observer : observers)
      processes().agree([&] { call(*observer); });
  }

  void ObservedRun::open()
  {
    if (checkpoints)
      observers.push_back(checkpoints);
    is_open = true;
    if (own_scene)
      processes().agree(
          [&]
          {
            if (processes().is_root())
              std::filesystem::create_directories(folder);
          });
    const RunView run = {folder, interval, processes(), checkpoints && checkpoints->is_found()};
    each([&](Observer &observer) { observer.begin(run); });
  }

  void ObservedRun::begin()
  {
    if (!is_open)
      open();
    first = Clock::now();
    if (checkpoints && checkpoints->is_found())
      checkpoints->go_on();
    else
      show(motion.start().state);
    first_time = time();
  }

  void ObservedRun::advance()
  {
    StepCosts &costs = motion.costs();
    costs.begin_step();
    motion.advance();
    costs.end_step();
    show(motion.state());
  }

  void ObservedRun::finish()
  {
    last = Clock::now();
    std::exception_ptr failure; // the first one; the others finish first
    for (Observer *observer : observers)
      try
      {
        observer->finish();
      }
      catch (...)
      {
        if (!failure)
          failure = std::current_exception();
      }
    if (failure)
      std::rethrow_exception(failure);
  }

  std::vector<std::string> ObservedRun::save() const
  {
    std::vector<std::string> stored;
    each([&](Observer &observer)
         { stored.push_back(archived([&](OutputArchive &archive) { observer.save(archive); })); });
    return stored;
  }

  void ObservedRun::resume(const std::vector<std::string> &stored)
  {
    if (stored.size() != observers.size())
      throw UserError("the checkpoint has " + std::to_string(stored.size()) +
                      " observers and this run " + std::to_string(observers.size()) +
                      ": resume with the same program");
    update_probes(motion.state());
    update_links(motion.state());
    reactions->update(motion.reference(), motion.state(), motion.links(), motion.report());
    const StepView step = view(motion.state());
    std::size_t i = 0;
    each(
        [&](Observer &observer) {
          unarchive(stored[i++], [&](InputArchive &archive) { observer.resume(archive, step); });
        });
  }

  StepView ObservedRun::view(const State &state) const
  {
    return {named,
            bodies,
            motion.links(),
            motion.reference(),
            state,
            motion.residuals(),
            motion.loads(),
            motion.report(),
            motion.measures(),
            probe_values,
            reactions->forces(),
            links,
            motion.costs().sums()};
  }

  void ObservedRun::show(const State &state)
  {
    update_probes(state);
    update_links(state);
    if (motion.has_moved())
      reactions->update(motion.reference(), state, motion.links(), motion.report());
    const StepView step = view(state);
    each([&](Observer &observer) { observer.record(step); });
  }

  void ObservedRun::update_links(const State &state)
  {
    const Constraints &rows = motion.links();
    const std::size_t n = std::max(named.links.size(), rows.n_links());
    links.force = rows.of_links(state.multiplier, n, std::move(links.force));
    links.gap = rows.of_links(state.distance, n, std::move(links.gap));
  }

  void ObservedRun::update_probes(const State &state)
  {
    for (std::size_t i = 0; i < probe_terms.size(); ++i)
      switch (named.probes[i].quantity)
      {
      case Probe::Quantity::displacement:
        probe_values[i] = evaluate(probe_terms[i], motion.reference().displacement) +
                          evaluate(probe_terms[i], state.U);
        break;
      case Probe::Quantity::velocity:
        probe_values[i] = evaluate(probe_terms[i], state.V);
        break;
      case Probe::Quantity::acceleration:
        probe_values[i] = evaluate(probe_terms[i], state.A);
        break;
      }
    // The signal to stop shares a message, so that all ranks stop at the same step.
    const int asked = stop_asked ? stop_asked() : 0;
    probe_values.push_back(asked);
    processes().sum(probe_values);
    if (probe_values.back() > 0.)
      stop_signal = static_cast<int>(processes().max(asked));
    probe_values.pop_back();
    for (std::size_t i = 0; i < probe_terms.size(); ++i)
      probe_values[i] -= probe_rest[i];
  }

  void ObservedRun::report(std::ostream &log, const bool failed) const
  {
    std::stringstream said;
    said.copyfmt(log);
    for (const Observer *observer : observers)
      observer->report(said, failed);
    if (!failed && motion.costs().sums().n_steps > 0)
      print_cost(said);
    // Warnings stand together at the end, whatever they are about.
    const std::string mark = "Warning: ";
    std::string warnings;
    for (std::string line; std::getline(said, line);)
      if (const std::size_t at = line.find_first_not_of(' ');
          at != std::string::npos && line.compare(at, mark.size(), mark) == 0)
        warnings += line.substr(at) + '\n';
      else
        log << line << '\n';
    log << warnings;
  }

  std::vector<NamedQuantity> ObservedRun::quantities() const
  {
    std::vector<NamedQuantity> all;
    for (const Observer *observer : observers)
    {
      const std::vector<NamedQuantity> own = observer->quantities();
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  }

  void ObservedRun::print_cost(std::ostream &log) const
  {
    const StepCosts::Sums &costs = motion.costs().sums();
    const double n_steps = static_cast<double>(costs.n_steps), seconds = costs.stepping,
                 simulated = time() - first_time;
    const double all = std::chrono::duration<double>(last - first).count();
    log << costs.n_steps << " steps in " << all << " s, " << simulated / all
        << " x real time; without output " << 1e6 * seconds / n_steps << " us a step, "
        << simulated / seconds << " x real time\n";
    if (!motion.is_linear())
      log << "Newton's method: " << static_cast<double>(motion.n_newton_iterations()) / n_steps
          << " solves a step\n";
    const InterfaceStatistics solves = motion.interface_statistics();
    if (solves.n_systems > 0)
      log << "Conjugate gradients: " << static_cast<double>(solves.n_iterations) / solves.n_systems
          << " iterations a system, " << static_cast<double>(solves.n_systems) / n_steps
          << " systems a step, "
          << static_cast<double>(solves.n_local_solves) / solves.n_applications
          << " bodies solved a product\n";
  }
} // namespace taut
