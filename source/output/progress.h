// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_progress_h
#define taut_progress_h

#include <taut/output/observer.h>

#include <chrono>
#include <iosfwd>

namespace taut
{
  /// Shows the progress of a run: a bar on a terminal, otherwise a line each tenth of the run.
  class Progress : public Observer
  {
  public:
    Progress(std::ostream &log, bool terminal, double end_time);
    void record(const StepView &step) override;
    void finish() override;

  private:
    std::ostream &log;
    bool terminal;
    double end_time;
    int shown = 0;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now(), drawn = begin;
  };
} // namespace taut

#endif
