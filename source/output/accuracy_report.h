// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_accuracy_report_h
#define taut_accuracy_report_h

#include "output/motion_record.h"
#include <taut/base/warning.h>
#include <taut/output/observer.h>
#include <taut/time/motion.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace taut
{
  /// A run from start to end that may be made once more in other steps.
  struct RunInSteps
  {
    Motion &motion;
    long n_steps; ///< of the length of its options

    bool at_any_cost = false;     ///< allows a run with shorter steps at any cost
    std::string other_cause = ""; ///< of errors, that was warned of before; empty: none

    /// The longest step that sees all of the scene, if the run does not; 0: not known [s].
    double seeing_step = std::numeric_limits<double>::infinity();
  };

  /**
   * Estimates the error of a run by its steps. Use it at the end of a run that is cheap enough to
   * repeat.
   *
   * The run is compared with one whose step is shorter by 4.24, and near the bounds of
   * MotionDifference, or if it has few steps, by the square of this (L. F. Richardson's
   * extrapolation, 1911). Beyond a bound, one of 4.24 times the step shows the order of the error,
   * from one to two. Adaptive steps are compared with a ninth of the tolerance and 1/4.24 of Step,
   * and more. If shorter steps cost too much, longer ones, or a looser tolerance, give a rough
   * error, a third of the difference; they may miss the same impact as the run. A run that does not
   * see all of the scene is compared with shorter steps alone, which have to see it: where this is
   * cheap, with steps that are shorter by a higher power of the golden ratio. What a run costs is
   * counted from the run itself: its steps, repetitions and iterations.
   */
  class StepAccuracy
  {
  public:
    explicit StepAccuracy(RunInSteps run);

    /// Whether there is another run that takes less than about half a second.
    static bool is_affordable(const RunInSteps &run);

    /// Whether shorter steps that are affordable see what the run does not.
    static bool sees_more(const RunInSteps &run);

    /// Whether steps that see all of the scene gave the same motion.
    bool is_confirmed() const { return found && !sees_all() && !too_long; }

    /// Whether shorter steps that resolve all contacts gave the same motion.
    bool is_resolved() const { return found && !too_long && resolves_contacts; }

    /// Records an accepted step of the run itself.
    void record(const State &state, const StepReport &report, const Residuals &residuals)
    {
      own.record(state, report);
      ++n_steps;
      n_iterations += residuals.iterations;
    }

    /// Makes the other runs. After each step @p stop may end them. Called by all ranks together.
    void measure(const std::function<bool()> &stop);

    /// Errors of the run, relative to its largest values; empty: unknown.
    const std::optional<MotionDifference> &error() const { return found; }

    /// For an error beyond its bound: its place and size, and the step or tolerance that the run
    /// needs.
    std::vector<Warning> warnings() const;

    /// One line for the log, and the warning if there is one.
    std::string report() const;

    void save(OutputArchive &archive) { own.save(archive); }
    void load(InputArchive &archive) { own.load(archive); }

  private:
    bool is_cheap(double about) const;
    bool sees_all() const { return !std::isfinite(run.seeing_step); }
    std::optional<MotionRecord::Differences> compare(double about,
                                                     const std::function<bool()> &stop);
    bool is_followed_by_longer() const;
    void compare_with_shorter(const std::function<bool()> &stop);
    void compare_with_longer(const std::function<bool()> &stop);
    double shortened(double over_bounds) const;
    std::vector<Warning> warning_of_end() const;

    const RunInSteps run;
    const double first_ratio; ///< ratio of the step to that of the first shorter run
    const ConnectedBodies groups;
    double work;                        ///< of the run: DoFs times solves; estimated, then counted
    long n_steps = 0, n_iterations = 0; ///< steps made, and iterations of the contact solver
    const std::size_t n_samples;
    const double interval; ///< between samples [s]
    MotionRecord own;
    std::optional<MotionDifference> found;
    bool too_long = false;
    bool is_rough = false;          ///< the error, from longer steps
    bool resolves_contacts = false; ///< a run with shorter steps, the shortest so far
    double order = 1.;              ///< of the error in the step
    std::string reason;             ///< why the error is unknown
  };

  /// Reports the measures of contacts at the end of a run, and on request the errors of its steps.
  class AccuracyReport : public Observer
  {
  public:
    /// @p measures are kept by reference. Without @p accuracy steps are not checked, for a reason
    /// in words. @p of_steps are warnings about steps that are known before the run; they go if
    /// steps that see all of the scene give the same motion.
    AccuracyReport(const ContactMeasures &measures, std::unique_ptr<StepAccuracy> accuracy,
                   std::string reason, std::vector<Warning> of_steps)
        : measures(measures), accuracy(std::move(accuracy)), reason(std::move(reason)),
          of_steps(std::move(of_steps))
    {
    }

    /// After the last step: makes the other runs for the check, see StepAccuracy::measure().
    void check_steps(const std::function<bool()> &stop);

    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    /// Warnings about contacts, then about steps. That impulses may be off is none if steps that
    /// resolve the contacts give the same motion.
    std::vector<Warning> warnings() const;

    /// A line for each measure, with its warnings; nothing if the run failed.
    void report(std::ostream &log, bool failed) const override;

  private:
    bool is_confirmed() const { return accuracy && accuracy->is_confirmed(); }
    std::vector<Warning> warnings_of_contacts() const;

    const ContactMeasures &measures;
    const std::unique_ptr<StepAccuracy> accuracy;
    const std::string reason;
    const std::vector<Warning> of_steps;
  };
} // namespace taut

#endif
