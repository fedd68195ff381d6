// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
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
    void report(std::ostream &log, const bool failed) const override
    {
      if (!failed)
        StepCosts::print(before, log);
    }

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

  void CostTable::begin(const RunView &run)
  {
    interval = run.interval;
    if (!run.communicator.is_root())
      return;
    std::vector<std::string> columns = {"time [s]", "steps [1]"};
    for (std::size_t i = 0; i < n_step_parts; ++i)
      columns.push_back(std::string(name_of(static_cast<StepPart>(i))) + " [us]");
    columns.insert(columns.end(), {"Newton iterations [1]", "active-set iterations [1]"});
    file = std::make_unique<TableFile>(run.folder + "/cost.csv", columns, run.resumes);
  }

  void CostTable::record(const StepView &step)
  {
    const StepCosts::Sums &now = step.costs;
    if (now.n_steps == before.n_steps) // the start
      return;
    time = step.state.time;
    of_line.n_steps += now.n_steps - before.n_steps;
    of_line.n_newton += now.n_newton - before.n_newton;
    for (std::size_t i = 0; i < n_step_parts; ++i)
      of_line.parts[i] += now.parts[i] - before.parts[i];
    iterations += step.residuals.iterations;
    before = now;
    if (time >= next - 1e-9 * interval)
      write_line();
  }

  void CostTable::write_line()
  {
    next = time + interval;
    const double n = static_cast<double>(of_line.n_steps);
    std::vector<double> values = {n};
    for (std::size_t i = 0; i < n_step_parts; ++i)
      values.push_back(1e6 * StepCosts::mean(of_line, static_cast<StepPart>(i)));
    values.push_back(static_cast<double>(of_line.n_newton) / n);
    values.push_back(iterations / n);
    if (file)
      file->add_line(time, values);
    of_line = {};
    iterations = 0.;
  }

  void CostTable::finish()
  {
    if (of_line.n_steps > 0)
      write_line();
    if (file)
      file->close();
  }

  void CostTable::save(OutputArchive &archive)
  {
    const std::size_t length = file ? file->save() : 0;
    archive << next << time << iterations << of_line.n_steps << of_line.n_newton;
    for (const double seconds : of_line.parts)
      archive << seconds;
    archive << length;
  }

  void CostTable::resume(InputArchive &archive, const StepView &step)
  {
    std::size_t length = 0;
    archive >> next >> time >> iterations >> of_line.n_steps >> of_line.n_newton;
    for (double &seconds : of_line.parts)
      archive >> seconds;
    archive >> length;
    before = step.costs;
    if (file)
      file->resume(length);
  }

  namespace
  {
    const Register<Observer, CostTable> register_cost_table(
        "cost", "cost.csv: wall time of each part of a step, Newton iterations and "
                "active-set iterations, means of the steps since the line before, as "
                "often as Interval says; and where the time of the run goes, in the log");
  }
} // namespace taut
