// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_accuracy_search_h
#define taut_accuracy_search_h

#include "study/study.h"
#include "study/trial_runs.h"

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Finds step and mesh for an accuracy without a stored study. Take it for a scene that is new,
   * and Study to compare schemes.
   *
   * The search starts from coarse values. It runs a centre, and the settings with one refinement
   * halved or doubled. Richardson extrapolation along each refinement gives the converged
   * quantities with their errors. A second scheme must come to the same values, and so must a run
   * with far shorter steps, where the budget has time for it. As long as no
   * setting is accurate enough, the refinement with the largest error is refined. Entries Exact of
   * section Study are not used.
   */
  class AccuracySearch
  {
  public:
    /// Wants a relative error of @p accuracy in (0, 1). @p overrides as for Parameters::read().
    /// Throws UserError. Messages go to @p log.
    AccuracySearch(const std::string &file, const std::vector<std::string> &overrides,
                   double accuracy, bool overwrite, std::ostream &log);

    /// As Simulation::stop_if(), asked after each step of each run.
    void stop_if(std::function<int()> asked) { runs.stop_if(std::move(asked)); }

    /**
     * Runs settings until one has the accuracy, and writes study.json and work_precision.csv for
     * Study/Accuracy. Returns the cheapest setting that has it, which result() holds. Throws
     * UserError if there is no such estimate within Study/Budget, and Interrupted.
     */
    const StudySetting &run();

    /// All settings that ran, with their errors.
    const StudyResult &result() const { return study; }

  private:
    using Levels = TrialRuns::Levels;

    const StudySetting &search();
    bool star_runs(const Levels &centre);
    void estimate(const Levels &centre);
    void find_scales();
    void rate_settings();
    void ask_second_scheme(const Levels &centre);
    bool look_far(const Levels &centre);
    void keep_results();
    void report(const StudySetting &best) const;
    UserError no_estimate(const std::string &reason) const;

    double accuracy;
    bool overwrite;
    std::ostream &log;
    TrialRuns runs;
    std::vector<QuantityReference> step_limits; ///< of each quantity, at the mesh of the centre
    std::vector<double> changes;                ///< relative, the largest along each refinement
    std::string second_scheme, failure;
    bool misses_something = false; ///< the failure is that of steps that do not see all
    StudyResult study;
  };
} // namespace taut

#endif
