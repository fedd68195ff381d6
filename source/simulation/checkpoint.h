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
  /// What a run needs to go on after a step with the same bits.
  struct Checkpoint
  {
    double time = 0.;                           ///< of the step [s]
    std::string build;                          ///< of the program, with its instruction set
    unsigned int n_ranks = 1;                   ///< that wrote it
    std::map<std::string, std::string> entries; ///< of the parameter file, by path
    std::string run;                            ///< what all ranks have alike
    std::vector<std::string> bodies;            ///< of each body of the system
    std::vector<std::string> observers;         ///< what each of them stored

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &time &build &n_ranks &entries &run &bodies &observers;
    }
  };

  /// The names of the files in the folder of the results: the last checkpoint, and the one before.
  constexpr const char *const checkpoint_names[] = {"checkpoint", "checkpoint.old"};

  /// Puts it into the folder; what was the last one there becomes the one before, unless it is
  /// damaged. Throws UserError
  /// if it cannot be written; the one before is still there then.
  void write_checkpoint(const Checkpoint &checkpoint, const std::string &folder);

  /**
   * The last checkpoint of the folder, or the one before if that is damaged, which is said in @p
   * log; none if there is no file. Throws UserError if none of the files can be used.
   */
  std::optional<Checkpoint> read_checkpoint(const std::string &folder, std::ostream &log);
} // namespace taut

#endif
