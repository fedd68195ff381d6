// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cost_table_h
#define taut_cost_table_h

#include <taut/output/observer.h>
#include <taut/output/table_file.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Writes the cost of the steps over time, cost.csv. Use it to find the times at which a run is
   * slow, and the part of a step that makes it so. A line has the steps since the line before:
   * their number, the mean wall time of each StepPart on the root [us], and the mean numbers of
   * Newton iterations, with those of repeated steps, and of active-set iterations [1]. Output is
   * that from the end of a step to the next.
   *
   * Wall times differ from run to run, also after a checkpoint.
   */
  class CostTable : public Observer
  {
  public:
    std::vector<std::string> files() const override { return {"cost.csv"}; }
    void begin(const RunView &run) override;
    void record(const StepView &step) override;

    /// Writes the remaining steps. Throws UserError if the disk is full.
    void finish() override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

  private:
    void write_line();

    double interval = 0., next = 0., time = 0.;
    StepCosts::Sums of_line; ///< since the line before
    StepCosts::Sums before;  ///< at the last record, of this process
    double iterations = 0.;  ///< of active sets, since the line before
    std::unique_ptr<TableFile> file;
  };
} // namespace taut

#endif
