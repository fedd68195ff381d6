// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_trial_runs_h
#define taut_trial_runs_h

#include "study/case_runner.h"
#include "study/refinements.h"

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace taut
{
  /// Runs a scene at levels of its refinements, each once, without files and within a wall time.
  class TrialRuns
  {
  public:
    using Levels = std::vector<int>; ///< of each refinement
    struct Trial
    {
      MeasuredRun run;
      double wall_seconds = 0.;
      std::string message; ///< reason of a failure; empty if it ran
    };

    /// @p file and @p overrides as for Parameters::read(); the wall time is Study/Budget. Runs of a
    /// scene that names no quantities take default_quantities(). Throws UserError.
    TrialRuns(std::string file, std::vector<std::string> overrides);

    /// As Simulation::stop_if(). The end of the wall time counts as the signal SIGALRM.
    void stop_if(std::function<int()> asked) { stop_asked = std::move(asked); }

    /// Sets the quantities of a scene that names none, from the coarsest setting that runs. Throws
    /// UserError and Interrupted.
    void name_quantities();

    /// The run at @p levels. Throws Interrupted.
    const Trial &at(const Levels &levels);

    /// The run at @p levels with another scheme, by name. Throws UserError and Interrupted.
    MeasuredRun with_scheme(const Levels &levels, const std::string &scheme) const;

    /// What the check of steps says of the motion of a run with these entries,
    /// "Section/Entry=value", or why it says nothing. Empty: it does not warn, or Time/Check steps
    /// is no. Throws Interrupted.
    std::string warning_of_steps(const std::vector<std::string> &entries) const;

    const Parameters &parameters() const { return file_parameters; }
    const std::vector<Refinement> &refinements() const { return all_refinements; }
    const std::map<Levels, Trial> &all() const { return trials; }

    /// Wall time since the construction [s].
    double elapsed() const;

  private:
    std::vector<std::string> entries(const Levels &levels) const;
    MeasuredRun run_once(const std::vector<std::string> &entries) const;
    int ask() const;

    std::string file;
    std::vector<std::string> overrides;
    std::function<int()> stop_asked;
    Parameters file_parameters;
    std::vector<Refinement> all_refinements;
    std::map<Levels, Trial> trials;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  };
} // namespace taut

#endif
