// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/checkpoint.h"

#include "base/data_files.h"
#include "base/instruction_set.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/base/version.h>
#include <taut/simulation/checkpoints.h>
#include <taut/simulation/observed_run.h>

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

    /// Begins the names of files among those of entries.
    const std::string file_mark = "file ";

    /// Among the names of entries: how many ranks share meshes.
    const std::string sharing_mark = "ranks that share meshes";

    std::map<std::string, std::string> with_files(std::map<std::string, std::string> entries,
                                                  const DataFiles &files,
                                                  const unsigned int n_sharing_ranks)
    {
      for (const auto &[name, text] : files)
        entries[file_mark + name] = digest(*text);
      entries[sharing_mark] = std::to_string(n_sharing_ranks);
      return entries;
    }
  } // namespace

  Checkpoints::Checkpoints(const std::string &folder, const double interval, std::ostream &log,
                           const std::map<std::string, std::string> &entries,
                           const DataFiles &files, const unsigned int n_sharing_ranks)
      : folder(folder), interval(interval), log(log),
        entries(with_files(entries, files, n_sharing_ranks)), next(interval)
  {
  }

  Checkpoints::~Checkpoints() = default;

  void Checkpoints::find(const Communicator &communicator)
  {
    processes = communicator;
    std::string text, file, digest;
    processes.agree(
        [&]
        {
          if (!processes.is_root())
            return;
          if (const auto last = read_checkpoint(folder, log))
          {
            check_origin(last->checkpoint);
            text = archived([&](OutputArchive &archive) { archive << last->checkpoint; });
            file = last->path;
            digest = last->digest;
          }
        });
    processes.broadcast(text);
    processes.broadcast(file);
    processes.broadcast(digest);
    if (text.empty())
    {
      log << "No checkpoint in " << folder << ": the run begins from the start\n";
      return;
    }
    auto last = std::make_shared<FoundCheckpoint>();
    last->path = file;
    last->digest = digest;
    unarchive(text, [&](InputArchive &archive) { archive >> last->checkpoint; });
    found = std::move(last);
  }

  /// Throws an EntryError on an entry that differs from that of the checkpoint, and warns of
  /// changes that may change the bits.
  void Checkpoints::check_origin(const Checkpoint &stored) const
  {
    const std::string own_folder = "Output/Folder"; // may have moved
    for (const auto &[path, value] : entries)
    {
      const auto before = stored.entries.find(path);
      if (path == own_folder || (before != stored.entries.end() && before->second == value))
        continue;
      if (path == sharing_mark)
        throw UserError(
            "ranks share the mesh of a body, whose parts depend on their number: resume "
            "the run on " +
            std::to_string(stored.n_ranks) + " ranks as before, or begin anew with --overwrite");
      if (path.compare(0, file_mark.size(), file_mark) == 0)
        throw UserError("the file '" + path.substr(file_mark.size()) +
                        "' is not what it was in the run that is to be resumed; put back the copy "
                        "that is in its folder, or begin anew with --overwrite");
      throw EntryError(path,
                       "the run that is to be resumed had " +
                           (before == stored.entries.end() ? std::string("no such entry")
                                                           : "'" + before->second + "' here") +
                           "; resume it as it was, or begin anew with --overwrite");
    }
    for (const auto &[path, value] : stored.entries)
      if (entries.find(path) == entries.end())
        throw UserError("the run that is to be resumed had the entry " + path + " = " + value +
                        ", which is gone; resume it as it was, or begin anew with --overwrite");
    if (stored.build != this_build())
      log << "Warning: the checkpoint was written by taut " << stored.build << " and this is taut "
          << this_build() << ": the last bits of the results may differ\n";
    if (stored.n_ranks != processes.size())
      log << "Warning: the checkpoint was written by " << stored.n_ranks
          << " ranks and this run has " << processes.size()
          << ": the last digits of the results may differ\n";
  }

  void Checkpoints::begin(const RunView &view)
  {
    processes = view.communicator;
    if (interval > 0. && !view.resumes)
      run->save();
  }

  void Checkpoints::record(const StepView &step)
  {
    const double now = step.state.time;
    if (!(interval > 0.) || now < next - rounding * interval)
      return;
    next = interval * (std::floor(now / interval + rounding) + 1.);
    Checkpoint stored;
    stored.time = now;
    stored.build = this_build();
    stored.n_ranks = processes.size();
    stored.entries = entries;
    stored.observers = run->save();
    stored.run = archived([&](OutputArchive &archive) { run->stepped().save(archive); });
    const Structure &bodies = run->stepped().bodies();
    stored.n_bodies = bodies.all_bodies().size();
    State state = run->stepped().state();
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < bodies.size(); ++k)
      numbers.push_back(bodies.number(k));
    write_checkpoint(
        stored, numbers,
        [&](const std::size_t k)
        {
          return archived(
              [&](OutputArchive &archive)
              {
                for (const BodyVectors *vectors : state.of_bodies())
                  archive << (*vectors)[k];
                bodies[k].save(archive);
              });
        },
        folder, processes);
  }

  void Checkpoints::save(OutputArchive &archive)
  {
    archive << next;
  }

  void Checkpoints::resume(InputArchive &archive, const StepView &)
  {
    archive >> next;
  }

  void Checkpoints::go_on()
  {
    State state;
    processes.agree([&] { state = restored_state(); });
    unarchive(found->checkpoint.run,
              [&](InputArchive &archive) { run->stepped().load(archive, std::move(state)); });
    run->resume(found->checkpoint.observers);
    log << "Resumed after t = " << found->checkpoint.time << " s\n";
  }

  /// State with the stored vectors of the bodies of this rank.
  State Checkpoints::restored_state() const
  {
    Motion &motion = run->stepped();
    const Structure &bodies = motion.bodies();
    const std::size_t n_bodies = bodies.all_bodies().size();
    if (found->checkpoint.n_bodies != n_bodies)
      throw UserError("the run of the checkpoint had " +
                      std::to_string(found->checkpoint.n_bodies) + " bodies and this one has " +
                      std::to_string(n_bodies) +
                      ": resume it with the same program and the same plugins");
    State state = motion.start().state;
    std::map<std::size_t, std::size_t> own;
    for (std::size_t k = 0; k < bodies.size(); ++k)
      own[bodies.number(k)] = k;
    read_bodies(
        *found, [&](const std::size_t number) { return own.count(number) > 0; },
        [&](const std::size_t number, const std::string &data)
        {
          const std::size_t k = own[number];
          unarchive(data,
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
                      motion.load_body(k, archive);
                    });
        });
    return state;
  }
} // namespace taut
