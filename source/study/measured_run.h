// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_measured_run_h
#define taut_measured_run_h

#include "study/quantity_recorder.h"
#include <taut/simulation/parameters.h>

#include <functional>
#include <vector>

namespace taut
{
  /// The quantities and the cost of one run of a study.
  struct MeasuredRun
  {
    std::vector<StudyQuantity> quantities;
    double seconds = 0.;     ///< processor time of the loop over the steps [s]
    double certificate = 0.; ///< largest residual of any step [1]
    long n_steps = 0;
  };

  /// Throws EntryError if the scene cannot be built, or lacks a quantity of its section Study.
  void check_quantities(const Parameters &parameters);

  /// Runs a scene with fixed steps. Without @p with_quantities it measures the cost alone.
  /// @p stop_asked as for Simulation::stop_if(). Throws UserError and Interrupted.
  MeasuredRun measure_run(const Parameters &parameters, bool with_quantities,
                          const std::function<int()> &stop_asked);
} // namespace taut

#endif
