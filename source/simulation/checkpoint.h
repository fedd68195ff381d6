// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_checkpoint_h
#define taut_checkpoint_h

#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace taut
{
  /// All data to continue a run after a step with the same bits.
  struct Checkpoint
  {
    double time = 0.;                           ///< of the step [s]
    std::string build;                          ///< version of the program with its instruction set
    unsigned int n_ranks = 1;                   ///< number of ranks that wrote it
    std::map<std::string, std::string> entries; ///< of the parameter file, by path
    std::string run;                            ///< data that are equal on all ranks
    std::vector<std::string> bodies;            ///< data of each body of the system
    std::vector<std::string> observers;         ///< data of each observer

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &time &build &n_ranks &entries &run &bodies &observers;
    }
  };

  /// Names of the files in the folder of the results: the last checkpoint and the one before it.
  constexpr const char *const checkpoint_names[] = {"checkpoint", "checkpoint.old"};

  /// Writes the checkpoint into the folder. An undamaged last checkpoint becomes the one before.
  /// Throws UserError if it cannot be written; the one before remains.
  void write_checkpoint(const Checkpoint &checkpoint, const std::string &folder);

  /// The last checkpoint of the folder, or the one before if that is damaged, with a message in
  /// @p log; none without files. Throws UserError if no file is usable.
  std::optional<Checkpoint> read_checkpoint(const std::string &folder, std::ostream &log);
} // namespace taut

#endif
