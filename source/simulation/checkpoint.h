// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_checkpoint_h
#define taut_checkpoint_h

#include <taut/base/communicator.h>

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace taut
{
  /// All data to continue a run after a step with the same bits, but those of the bodies, which
  /// stay in the file.
  struct Checkpoint
  {
    double time = 0.;                           ///< of the step [s]
    std::string build;                          ///< version of the program with its instruction set
    unsigned int n_ranks = 1;                   ///< number of ranks that wrote it
    std::size_t n_bodies = 0;                   ///< of the system
    std::map<std::string, std::string> entries; ///< of the parameter file, by path
    std::string run;                            ///< data that are equal on all ranks
    std::vector<std::string> observers;         ///< data of each observer

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &time &build &n_ranks &n_bodies &entries &run &observers;
    }
  };

  /// Names of the files in the folder of the results: the last checkpoint and the one before it.
  constexpr const char *const checkpoint_names[] = {"checkpoint", "checkpoint.old"};

  /// Data of a body by its index on the rank.
  using BodyData = std::function<std::string(std::size_t k)>;

  /**
   * Writes the checkpoint into the folder, and behind it the bodies of one rank after the other, of
   * which this rank has those with the @p numbers in the system. An undamaged last checkpoint
   * becomes the one before. Called by all ranks together, which share the folder. Throws UserError
   * if it cannot be written; the one before remains.
   */
  void write_checkpoint(const Checkpoint &checkpoint, const std::vector<std::size_t> &numbers,
                        const BodyData &data, const std::string &folder,
                        const Communicator &processes);

  struct FoundCheckpoint
  {
    Checkpoint checkpoint;
    std::string path;   ///< of its file
    std::string digest; ///< of the checkpoint, as the file has it
  };

  /// The last checkpoint of the folder, or the one before if that is damaged, with a message in
  /// @p log; none without files. Throws UserError if no file is usable.
  std::optional<FoundCheckpoint> read_checkpoint(const std::string &folder, std::ostream &log);

  /// Calls @p take with the data of the bodies that are wanted by their numbers. Throws UserError
  /// if the file has changed, or is another one on this rank.
  void read_bodies(const FoundCheckpoint &found, const std::function<bool(std::size_t)> &is_wanted,
                   const std::function<void(std::size_t, const std::string &)> &take);
} // namespace taut

#endif
