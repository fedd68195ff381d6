// SPDX-License-Identifier: LGPL-2.1-or-later
// How a run stores checkpoints and goes on from one.
#include "checkpoint.h"
#include "observer_list.h"

#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/base/instruction_set.h>
#include <taut/base/version.h>
#include <taut/simulation/simulation.h>
#include <taut/time/step_accuracy.h>

#include <cmath>
#include <ostream>

namespace taut
{
  namespace
  {
    /// Part of an interval by which a time may miss a multiple of it.
    constexpr double rounding = 1e-9;

    std::string this_build()
    {
      return version() + ", " + instruction_set_in_use();
    }

    /// What bodies stored, by their number in the system.
    using StoredBodies = std::map<std::size_t, std::string>;
  } // namespace

  /// The checkpoint of the folder on all ranks, if the run is to resume.
  void Simulation::find_checkpoint()
  {
    next_checkpoint = parameters.output.checkpoint_interval;
    if (!parameters.output.resume)
      return;
    std::string text;
    on_root(
        [&]
        {
          if (const auto found = read_checkpoint(parameters.output.folder, log))
          {
            check_origin(*found);
            text = archived([&](OutputArchive &archive) { archive << *found; });
          }
        });
    processes.broadcast(text);
    if (text.empty())
    {
      log << "No checkpoint in " << parameters.output.folder << ": the run begins from the start\n";
      return;
    }
    auto found = std::make_shared<Checkpoint>();
    unarchive(text, [&](InputArchive &archive) { archive >> *found; });
    checkpoint = std::move(found);
  }

  /// Throws an EntryError on an entry that the run of the checkpoint had otherwise, and says what
  /// may change its bits.
  void Simulation::check_origin(const Checkpoint &found) const
  {
    const std::string folder = "Output/Folder"; // may have been moved
    const std::map<std::string, std::string> &now = parameters.values();
    for (const auto &[path, value] : now)
    {
      const auto before = found.entries.find(path);
      if (path == folder || (before != found.entries.end() && before->second == value))
        continue;
      throw EntryError(path, "the run that is to be resumed had " +
                                 (before == found.entries.end() ? std::string("no such entry")
                                                                : "'" + before->second + "' here") +
                                 "; resume it as it was, or begin anew with --overwrite");
    }
    for (const auto &[path, value] : found.entries)
      if (now.find(path) == now.end())
        throw UserError("the run that is to be resumed had the entry " + path + " = " + value +
                        ", which is gone; resume it as it was, or begin anew with --overwrite");
    if (found.build != this_build())
      log << "Warning: the checkpoint was written by taut " << found.build << " and this is taut "
          << this_build() << ": the last bits of the results may differ\n";
    if (found.n_ranks != processes.size())
      log << "Warning: the checkpoint was written by " << found.n_ranks
          << " ranks and this run has " << processes.size()
          << ": the last digits of the results may differ\n";
  }

  void Simulation::save_checkpoint(TimeStepper &stepper, StepControl &control,
                                   const ObserverList &observers)
  {
    const double interval = parameters.output.checkpoint_interval, now = stepper.state().time;
    if (!(interval > 0.) || now < next_checkpoint - rounding * interval)
      return;
    next_checkpoint = interval * (std::floor(now / interval + rounding) + 1.);
    Checkpoint stored;
    stored.time = now;
    stored.build = this_build();
    stored.n_ranks = processes.size();
    stored.entries = parameters.values();
    stored.observers = observers.save();
    stored.run = archived(
        [&](OutputArchive &archive)
        {
          stepper.save(archive);
          const StepControl &steps = control;
          archive << steps << next_checkpoint;
          measures->save(archive);
          if (accuracy)
            accuracy->save(archive);
          limits->save(archive);
        });
    State state = stepper.state();
    StoredBodies own;
    for (std::size_t k = 0; k < bodies.size(); ++k)
      own[bodies.number(k)] = archived(
          [&](OutputArchive &archive)
          {
            for (const BodyVectors *vectors : state.of_bodies())
              archive << (*vectors)[k];
            bodies[k].save(archive);
          });
    for (const std::string &text :
         processes.gather(archived([&](OutputArchive &archive) { archive << own; })))
    {
      StoredBodies of_rank;
      unarchive(text, [&](InputArchive &archive) { archive >> of_rank; });
      stored.bodies.resize(bodies.all_bodies().size());
      for (const auto &[number, body] : of_rank)
        stored.bodies[number] = body;
    }
    on_root([&] { write_checkpoint(stored, parameters.output.folder); });
  }

  void Simulation::resume(TimeStepper &stepper, StepControl &control, const ObserverList &observers)
  {
    processes.agree(
        [&]
        {
          if (checkpoint->observers.size() != observers.size())
            throw UserError("the checkpoint has " + std::to_string(checkpoint->observers.size()) +
                            " observers and this run " + std::to_string(observers.size()) +
                            ": resume with the same program");
        });
    State state;
    processes.agree([&] { state = restored_state(); });
    unarchive(checkpoint->run,
              [&](InputArchive &archive)
              {
                stepper.load(archive, std::move(state));
                archive >> control >> next_checkpoint;
                measures->load(archive);
                if (accuracy)
                  accuracy->load(archive);
                limits->load(archive);
              });
    coefficients = stepper.scheme();
    update_probes(stepper.state());
    reactions.update(reference, stepper.state(), links, coefficients);
    observers.resume(checkpoint->observers, view(stepper.state(), stepper.certificate()));
    log << "Resumed after t = " << checkpoint->time << " s\n";
  }

  /// The vectors of the bodies of this rank.
  State Simulation::restored_state()
  {
    State state = start;
    for (std::size_t k = 0; k < bodies.size(); ++k)
    {
      if (checkpoint->bodies.size() != bodies.all_bodies().size())
        throw UserError("the run of the checkpoint had " +
                        std::to_string(checkpoint->bodies.size()) + " bodies and this one has " +
                        std::to_string(bodies.all_bodies().size()) +
                        ": resume it with the same program and the same plugins");
      unarchive(checkpoint->bodies[bodies.number(k)],
                [&](InputArchive &archive)
                {
                  for (BodyVectors *vectors : state.of_bodies())
                  {
                    const std::size_t n = (*vectors)[k].size();
                    archive >> (*vectors)[k];
                    if ((*vectors)[k].size() != n)
                      throw UserError("body '" + bodies[k].name() +
                                      "' had another number of DoFs in the run that is to be "
                                      "resumed");
                  }
                  bodies.load(k, archive);
                });
    }
    return state;
  }
} // namespace taut
