// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/step_costs.h>

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <vector>

namespace taut
{
  namespace
  {
    /// Share below which a part has no line in the log: it would be 0.0 %.
    constexpr double negligible = 5e-4;
  } // namespace

  const char *name_of(const StepPart part)
  {
    constexpr const char *names[n_step_parts] = {
        "places of constraints", "factors and F",       "moving rows of F",
        "loads and history",     "free gaps",           "contact problem",
        "solve of bodies",       "nonlinear bodies",    "state and balance",
        "certificate",           "velocity projection", "energy",
        "contact measures",      "step control",        "output"};
    return names[static_cast<std::size_t>(part)];
  }

  void StepCosts::begin_step()
  {
    begun = before = Clock::now();
    if (all.n_steps > 0)
      all.parts[static_cast<std::size_t>(StepPart::output)] += seconds(ended, begun);
    is_in_step = true;
  }

  void StepCosts::end_step()
  {
    ended = Clock::now();
    ++all.n_steps;
    all.stepping += seconds(begun, ended);
    is_in_step = false;
  }

  void StepCosts::add(const StepPart part)
  {
    const Clock::time_point now = Clock::now();
    all.parts[static_cast<std::size_t>(part)] += seconds(before, now);
    before = now;
  }

  double StepCosts::mean(const Sums &sums, const StepPart part)
  {
    return sums.n_steps > 0 ? sums.parts[static_cast<std::size_t>(part)] / sums.n_steps : 0.;
  }

  void StepCosts::print(const Sums &sums, std::ostream &log)
  {
    struct Line
    {
      StepPart part;
      double seconds;
    };
    std::vector<Line> lines;
    double total = 0.;
    for (std::size_t i = 0; i < n_step_parts; ++i)
    {
      const StepPart part = static_cast<StepPart>(i);
      lines.push_back({part, mean(sums, part)});
      total += lines.back().seconds;
    }
    if (!(total > 0.))
      return;
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Line &a, const Line &b) { return a.seconds > b.seconds; });
    log << "Where the time goes, us a step:\n";
    const std::ios::fmtflags flags = log.flags();
    const std::streamsize precision = log.precision();
    for (const Line &line : lines)
      if (line.seconds > negligible * total)
        log << "  " << std::left << std::setw(22) << name_of(line.part) << std::right << std::fixed
            << std::setprecision(2) << std::setw(12) << 1e6 * line.seconds << std::setprecision(1)
            << std::setw(7) << 100. * line.seconds / total << " %\n";
    log.flags(flags);
    log.precision(precision);
  }
} // namespace taut
