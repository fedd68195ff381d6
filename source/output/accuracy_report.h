// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_accuracy_report_h
#define taut_accuracy_report_h

#include "output/step_accuracy.h"
#include <taut/output/observer.h>

#include <functional>
#include <memory>
#include <vector>

namespace taut
{
  /// Reports the measures of contacts at the end of a run, and on request the errors of its steps.
  class AccuracyReport : public Observer
  {
  public:
    /// @p measures are kept by reference; without @p accuracy steps are not checked.
    explicit AccuracyReport(const ContactMeasures &measures,
                            std::unique_ptr<StepAccuracy> accuracy = nullptr)
        : measures(measures), accuracy(std::move(accuracy))
    {
    }

    /// After the last step: makes the other runs for the check, see StepAccuracy::measure().
    void check_steps(const std::function<bool()> &stop);

    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    /// Warnings about contacts, then about steps.
    std::vector<Warning> warnings() const;

    /// A line for each measure, with its warnings; nothing if the run failed.
    void report(std::ostream &log, bool failed) const override;

  private:
    const ContactMeasures &measures;
    const std::unique_ptr<StepAccuracy> accuracy;
  };
} // namespace taut

#endif
