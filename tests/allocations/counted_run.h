// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_allocations_counted_run_h
#define taut_allocations_counted_run_h

#include "allocation_hook.h"

#include <verification/run.h>

namespace allocations
{
  /// Steps before those that are counted, and steps that are counted, at most.
  struct Steps
  {
    long warm_up = 50;
    long counted = 100;
  };

  /// What the counted steps of a scene allocate, with their observers but without tables, fields
  /// and checkpoints.
  struct CountedRun
  {
    std::vector<long> by_step;
    std::string ending; ///< empty, or the error that ended the run

    long total() const;
    long largest() const;
    long n_without() const; ///< steps without allocations
  };

  /// Names of the scenes of prm/ that move.
  std::vector<std::string> moving_scenes();

  /// Runs a scene up to the last counted step. A short scene has a third of its steps as warm-up.
  CountedRun run_counted(verification::Session &session, const Steps &steps);

  /// The same of a scene of prm/.
  CountedRun run_counted(const std::string &scene, const Steps &steps,
                         const std::vector<std::string> &overrides = {});
} // namespace allocations

#endif
