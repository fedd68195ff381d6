// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/accuracy_report.h"

#include <ostream>

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
      accuracy->record(step.state, step.report);
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

  std::vector<Warning> AccuracyReport::warnings() const
  {
    std::vector<Warning> result = measures.warnings();
    for (const Warning &warning : accuracy ? accuracy->warnings() : std::vector<Warning>())
      result.push_back(warning);
    return result;
  }

  void AccuracyReport::report(std::ostream &log, const bool failed) const
  {
    if (failed)
      return;
    log << measures.report();
    if (accuracy)
      log << accuracy->report();
  }
} // namespace taut
