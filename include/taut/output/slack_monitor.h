// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_slack_monitor_h
#define taut_slack_monitor_h

#include <taut/output/observer.h>

#include <iosfwd>
#include <vector>

namespace taut
{
  /// Detects when and where each body first goes slack, see SlenderBody::is_slack().
  class SlackMonitor : public Observer
  {
  public:
    void begin(const RunView &run) override { processes = run.communicator; }
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    /// A line for each slack body, at most six; nothing with several ranks if the run failed.
    void report(std::ostream &log, bool failed) const override;

  private:
    /// Data of a body.
    enum Entry
    {
      is_found,
      time,
      place,
      bending_stiffness,
      axial_damping,
      is_straight,
      disturbance,
      n_entries
    };

    /// Data of all bodies over all ranks, n_entries each.
    std::vector<double> of_all_ranks() const;

    Communicator processes;
    std::vector<Structure::Body> bodies;
    std::vector<double> own; ///< data from this rank, zero for other bodies; n_entries each
    std::vector<std::size_t> watched; ///< bodies here that have not been slack so far
    std::vector<double> U;            ///< of one body, kept for its memory
    bool is_new = true;
  };
} // namespace taut

#endif
