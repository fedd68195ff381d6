// SPDX-License-Identifier: LGPL-2.1-or-later

#include "output/accuracy_report.h"
#include "base/text.h"
#include "time/longest_step.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>
#include <utility>

namespace taut
{
  void AccuracyReport::check_steps(const std::function<bool()> &stop)
  {
    if (accuracy)
      accuracy->measure(stop);
  }

  void AccuracyReport::record(const StepView &step)
  {
    const bool is_start = step.state.last_step == 0.;
    if (accuracy && !is_start)
      accuracy->record(step.state, step.report, step.residuals);
  }

  void AccuracyReport::save(OutputArchive &archive)
  {
    if (accuracy)
      accuracy->save(archive);
  }

  void AccuracyReport::resume(InputArchive &archive, const StepView &)
  {
    if (accuracy)
      accuracy->load(archive);
  }

  std::vector<Warning> AccuracyReport::warnings_of_contacts() const
  {
    std::vector<Warning> result;
    for (const Warning &warning : measures.warnings())
      if (!(warning.kind == "contact_momentum" && accuracy && accuracy->is_resolved()))
        result.push_back(warning);
    return result;
  }

  std::vector<Warning> AccuracyReport::warnings() const
  {
    std::vector<Warning> result = warnings_of_contacts();
    if (!is_confirmed())
      result.insert(result.end(), of_steps.begin(), of_steps.end());
    for (const Warning &warning : accuracy ? accuracy->warnings() : std::vector<Warning>())
      result.push_back(warning);
    return result;
  }

  void AccuracyReport::report(std::ostream &log, const bool failed) const
  {
    if (failed)
      return;
    log << measures.report();
    for (const Warning &warning : warnings_of_contacts())
      log << "  Warning: " << warning.message << '\n';
    if (accuracy)
      log << accuracy->report();
    else if (!reason.empty())
      log << "Steps: not checked, as " << reason << '\n';
    if (is_confirmed())
      return;
    for (const Warning &warning : of_steps)
      log << "  Warning: " << warning.message << '\n';
  }

  namespace
  {
    /// Largest number of samples in a run.
    constexpr long most_samples = 1000;

    /// Number of steps below which longer steps say nothing.
    constexpr long least_steps = 64;

    /// Ratio of the steps of another run, longer or shorter: the third power of the golden ratio,
    /// so that impacts have different places within a step in both.
    constexpr double golden_ratio = 1.618033988749895,
                     ratio_of_steps = golden_ratio * golden_ratio * golden_ratio;

    /// Power of the step ratio in the tolerance of adaptive steps: local errors have order three,
    /// errors of a run order two.
    constexpr double power_of_tolerance = 1.5;

    /// Lengths of adaptive steps are powers of two, up to twice as long as the tolerance asks for.
    constexpr double rounding_of_lengths = .5;

    /// Bounds of differences from shorter steps over the bounds of MotionDifference: an error is
    /// within its bound below the first and beyond above the second, even if the shorter steps are
    /// no better. Two runs whose impacts are off by more agree so well by chance in a part of cases
    /// that falls with the first.
    constexpr double surely_good = .1, surely_bad = 1.25;

    /// Part of the bounds for the recommended step, and bound of the difference to the shortest
    /// steps plus their own estimated error.
    constexpr double aim = .8, good = .95;

    /// Products of DoFs and steps in another run; a second has about a hundred millions. A step
    /// costs as much as some DoFs. Nonlinear bodies need several solutions, turning links about
    /// two.
    constexpr double most_work = 4e7, work_of_step = 100., work_of_newton = 8.,
                     work_of_turning = 2.;

    bool keeps_state(const Substructure &body)
    {
      return archived([&](OutputArchive &archive) { body.save(archive); }) !=
             archived([](OutputArchive &) {});
    }

    std::size_t samples_of(const RunInSteps &run)
    {
      const long stride = (run.n_steps + most_samples - 1) / most_samples;
      return static_cast<std::size_t>(run.n_steps / std::max(1L, stride));
    }

    double interval_of(const RunInSteps &run)
    {
      return run.motion.settings().step *
             std::max(1L, (run.n_steps + most_samples - 1) / most_samples);
    }

    /// Of one solution of all bodies.
    double work_of_solution(const RunInSteps &run)
    {
      double n_dofs = 0.;
      for (const Structure::Body &body : run.motion.bodies().all_bodies())
        n_dofs += static_cast<double>(body.n_dofs);
      return work_of_step + n_dofs + static_cast<double>(run.motion.links().n_of_all());
    }

    /// An estimate before the run.
    double work_of(const RunInSteps &run)
    {
      double n_nonlinear = 0.;
      for (std::size_t k = 0; k < run.motion.bodies().size(); ++k)
        n_nonlinear += !run.motion.bodies()[k].is_linear();
      run.motion.bodies().communicator().sum(&n_nonlinear, 1);
      const double solutions = n_nonlinear > 0.                             ? work_of_newton
                               : !run.motion.links().turning_rows().empty() ? work_of_turning
                                                                            : 1.;
      return static_cast<double>(run.n_steps) * work_of_solution(run) * solutions;
    }

    bool has_longer_steps(const RunInSteps &run)
    {
      return run.n_steps >= least_steps;
    }

    /// Ratio of the step to a shorter one that sees all of the scene.
    double ratio_that_sees(const RunInSteps &run)
    {
      double ratio = ratio_of_steps;
      while (ratio * run.seeing_step < run.motion.settings().step)
        ratio *= golden_ratio;
      return ratio;
    }

    std::string percent(const double part)
    {
      return to_text(std::setprecision(2), 100. * part, " %");
    }
  } // namespace

  StepAccuracy::StepAccuracy(RunInSteps from)
      : run(std::move(from)), first_ratio(ratio_that_sees(run)),
        groups(run.motion.bodies(), run.motion.links()), work(work_of(run)),
        n_samples(samples_of(run)), interval(interval_of(run)),
        own(run.motion.bodies(), run.motion.links(), groups, run.motion.reference(),
            run.motion.start().state, interval, n_samples)
  {
  }

  bool StepAccuracy::is_affordable(const RunInSteps &run)
  {
    return work_of(run) <=
           most_work * (has_longer_steps(run) ? ratio_of_steps : 1. / ratio_of_steps);
  }

  bool StepAccuracy::sees_more(const RunInSteps &run)
  {
    const StepperOptions &options = run.motion.settings();
    if (options.steps.adaptive() || run.seeing_step == 0.)
      return false;
    const double ratio = ratio_that_sees(run);
    return ratio == ratio_of_steps || work_of(run) * ratio <= most_work;
  }

  /// Whether a run with steps that are so many times as long takes less than about half a second.
  bool StepAccuracy::is_cheap(const double about) const
  {
    return work <= most_work * about;
  }

  /// Difference from a run to the same end with steps that are about so many times as long;
  /// nothing: no such run.
  std::optional<MotionRecord::Differences> StepAccuracy::compare(const double about,
                                                                 const std::function<bool()> &stop)
  {
    const long n = std::max(1L, std::lround(static_cast<double>(run.n_steps) / about));
    const double factor = static_cast<double>(run.n_steps) / static_cast<double>(n),
                 step = run.motion.settings().step * factor;
    StepParameters control = run.motion.settings().steps;
    control.tolerance = std::min(1., control.tolerance * std::pow(factor, power_of_tolerance));
    control.largest *= factor;
    std::vector<LongestStep> longest_steps = run.motion.longest_steps_in_contacts();
    for (LongestStep &longest : longest_steps)
      longest.factor *= factor;
    try
    {
      Motion motion(run.motion, step, control, longest_steps, n);
      MotionRecord other(run.motion.bodies(), run.motion.links(), groups, run.motion.reference(),
                         run.motion.start().state, interval, n_samples);
      while (!motion.is_finished())
      {
        motion.advance();
        other.record(motion.state(), motion.report());
        if (stop())
        {
          reason = "the check was ended";
          return std::nullopt;
        }
      }
      if (about < 1.)
      {
        const ContactMeasures::Summary summary = motion.measures().summary();
        resolves_contacts = summary.relative_energy <= ContactMeasures::suspicious_energy &&
                            summary.relative_momentum <= ContactMeasures::suspicious_momentum;
      }
      // Impacts of the better run are off by the ratio of both steps, and are at the ends of its
      // steps: if they are off as much the other way, two of these ratios are missing.
      return own.differences(other, 1. - 2. * std::min(about, 1. / about));
    }
    catch (const UserError &e)
    {
      // An error without an entry may be on this rank alone, and ends the run.
      if (run.motion.bodies().communicator().size() > 1 && !dynamic_cast<const EntryError *>(&e))
        throw;
      reason = to_text("a run with a step of ", step, " s ended: ", e.what());
      return std::nullopt;
    }
  }

  void StepAccuracy::measure(const std::function<bool()> &stop)
  {
    bool has_state = false;
    for (std::size_t k = 0; k < run.motion.bodies().size(); ++k)
      has_state = has_state || keeps_state(run.motion.bodies()[k]);
    if (run.motion.bodies().communicator().any(has_state))
    {
      reason = "a body keeps a state of its own";
      return;
    }
    const double n_solutions = run.motion.is_linear()
                                   ? static_cast<double>(n_steps + run.motion.n_repeated())
                                   : static_cast<double>(run.motion.n_newton_iterations());
    work = n_solutions * work_of_solution(run) +
           static_cast<double>(n_iterations) *
               (work_of_step + static_cast<double>(run.motion.links().n_of_all()));
    if ((run.at_any_cost && first_ratio == ratio_of_steps) || is_cheap(1. / first_ratio))
      compare_with_shorter(stop);
    else if (first_ratio > ratio_of_steps)
      reason = "something lies between them, and steps that see it take long";
    else if (is_followed_by_longer() && is_cheap(ratio_of_steps))
      compare_with_longer(stop);
    else
      reason = "runs with other steps take long: set Time/Check steps = yes for them";
  }

  /// Whether steps that are longer by the ratio say something.
  bool StepAccuracy::is_followed_by_longer() const
  {
    return sees_all() && has_longer_steps(run);
  }

  void StepAccuracy::compare_with_shorter(const std::function<bool()> &stop)
  {
    const auto shorter = compare(1. / first_ratio, stop);
    if (!shorter)
      return;
    // A run of few steps, or adaptive ones, may agree by chance.
    const bool is_of_many = is_followed_by_longer() && !run.motion.settings().steps.adaptive();
    const double least = shorter->least.over_bounds(), most = shorter->most.over_bounds();
    too_long = !(least <= surely_bad);
    found = too_long ? shorter->least : shorter->most;
    if (!too_long)
    {
      const double shortest = first_ratio * ratio_of_steps;
      double ratio = first_ratio, in_line = 0.; // with the change from one to the other
      if (!(is_of_many && most <= surely_good) && is_cheap(1. / shortest))
        if (const auto finest = compare(1. / shortest, stop))
        {
          ratio = shortest;
          found = finest->most;
          in_line = 2. * found->over_bounds() - least;
        }
      // The shorter steps have an error, too, of first order at impacts.
      found->scale(ratio / (ratio - 1.));
      too_long = !(std::max(found->over_bounds(), in_line) <= good);
    }
    if (const auto longer = too_long && is_of_many ? compare(ratio_of_steps, stop) : std::nullopt)
      order = std::clamp(std::log(longer->most.over_bounds() / most) / std::log(ratio_of_steps), 1.,
                         2.);
  }

  /// The error is at least larger by the ratio with longer steps.
  void StepAccuracy::compare_with_longer(const std::function<bool()> &stop)
  {
    const auto longer = compare(ratio_of_steps, stop);
    if (!longer)
      return;
    MotionDifference rough = longer->most;
    rough.scale(1. / (ratio_of_steps - 1.));
    rough.impulse_at_end = 0.; // impacts of longer steps are off by more than those of the run
    found = rough;
    too_long = !(rough.over_bounds() <= good);
    is_rough = true;
  }

  /// Part of the step with which the error falls to its bound.
  double StepAccuracy::shortened(const double over_bounds) const
  {
    return std::min(.5, std::pow(aim / over_bounds, 1. / order));
  }

  /// A contact so near the end that its whole impulse hangs on the time when it begins.
  std::vector<Warning> StepAccuracy::warning_of_end() const
  {
    if (!found || found->impulse_at_end <= MotionDifference::impulse_bound)
      return {};
    return {{"end",
             to_text("the impulse of '", found->name_at_end,
                     "' until the end of the run is off by ", percent(found->impulse_at_end),
                     " of the largest, as it is early or late there. Take a later Time/End"),
             found->impulse_at_end, MotionDifference::impulse_bound, "1", run.motion.state().time}};
  }

  std::vector<Warning> StepAccuracy::warnings() const
  {
    if (!too_long)
      return warning_of_end();
    const double part = std::isfinite(found->over_bounds()) ? shortened(found->over_bounds()) : .1;
    const std::string body = "'" + run.motion.bodies().all_bodies()[found->body].name + "'";
    std::ostringstream out;
    out.precision(2);
    if (run.other_cause.empty())
      out << "the step is too long: ";
    if (found->is_place())
      out << "the place of " << body << " is off by " << percent(found->place)
          << " of the largest motion at t = " << found->time << " s";
    else if (found->is_impulse())
      out << "the impulse of '" << found->name << "' is off by " << percent(found->impulse)
          << " of the largest";
    else
      out << "the energy of what is connected with " << body << " is off by "
          << percent(found->energy) << " of the largest";
    if (!run.other_cause.empty())
      out << ": " << run.other_cause;
    else if (run.motion.settings().steps.adaptive())
      out << ". Take a Tolerance of about "
          << run.motion.settings().steps.tolerance *
                 std::pow(rounding_of_lengths * part, power_of_tolerance);
    else
      out << ". Take a step of about "
          << std::min(run.motion.settings().step * part, run.seeing_step) << " s";
    return {{"step", out.str(), found->over_bounds(), 1., "1", found->time}};
  }

  std::string StepAccuracy::report() const
  {
    if (!found)
      return reason.empty() ? "Steps: not checked, as the run was ended\n"
                            : "Steps: the error is not known, as " + reason + '\n';
    std::string text =
        "Steps: error of places " + percent(found->place) + ", of impulses " +
        percent(found->impulse) + ", of energies " + percent(found->energy) + " of the largest, " +
        (is_rough ? "about, from a run with longer steps" : "from runs with other steps");
    if (too_long && !run.other_cause.empty())
      return text + ". The cause may be the joints that the log warns of\n";
    text += '\n';
    for (const Warning &warning : warnings())
      text += "  Warning: " + warning.message + '\n';
    return text;
  }
} // namespace taut
