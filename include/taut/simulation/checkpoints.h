// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_checkpoints_h
#define taut_checkpoints_h

#include <taut/output/observer.h>

#include <iosfwd>
#include <map>
#include <memory>
#include <string>

namespace taut
{
  class ObservedRun;
  class Motion;
  struct Checkpoint;
  struct FoundCheckpoint;

  /// Stores a run at intervals, so that a killed run continues from there with the same bits. Each
  /// observer stores its own part, see Observer::save(). To continue, call find() before
  /// ObservedRun::observe(), with all else unchanged.
  class Checkpoints : public Observer
  {
  public:
    /// Stores every @p interval [s] of a run in @p folder; 0: never. Messages go to @p log. The
    /// @p entries, by name, and the contents of the @p files have to be the same in a continued
    /// run, and so has the number of ranks that share meshes, on which parts of bodies depend; 0:
    /// none are shared.
    Checkpoints(const std::string &folder, double interval, std::ostream &log,
                const std::map<std::string, std::string> &entries = {},
                const std::map<std::string, std::shared_ptr<const std::string>> &files = {},
                unsigned int n_sharing_ranks = 0);
    ~Checkpoints() override;

    /// Reads the last checkpoint of the folder, if any. Throws UserError if it is unusable or a
    /// file differs, and EntryError on an entry that differs. Called by all ranks together.
    void find(const Communicator &communicator = Communicator());
    bool is_found() const { return found != nullptr; }

    /// @p observed is kept by reference.
    void set_run(ObservedRun &observed) { run = &observed; }

    /// Sets the run to the checkpoint. Throws UserError if it has other bodies or observers.
    void go_on();

    /// Throws if an observer stores no checkpoints.
    void begin(const RunView &view) override;
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

  private:
    void check_origin(const Checkpoint &stored) const;
    State restored_state() const;

    const std::string folder;
    const double interval;
    std::ostream &log;
    const std::map<std::string, std::string> entries;
    Communicator processes;
    ObservedRun *run = nullptr;
    std::shared_ptr<const FoundCheckpoint> found; ///< checkpoint to continue from
    double next;                                  ///< [s]
  };
} // namespace taut

#endif
