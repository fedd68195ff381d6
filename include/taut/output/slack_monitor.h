// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_slack_monitor_h
#define taut_slack_monitor_h

#include <taut/output/observer.h>

#include <iosfwd>
#include <vector>

namespace taut
{
  /// Notes when and where each body first goes slack, see SlenderBody::is_slack().
  class SlackMonitor : public Observer
  {
  public:
    void begin(const RunView &run) override { processes = run.communicator; }
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    /// A line for each of them, at most six; none of several ranks if the run failed.
    void report(std::ostream &log, bool failed) const override;

  private:
    /// What is known of a body.
    enum Entry
    {
      is_found,
      time,
      place,
      bending_stiffness,
      axial_damping,
      n_entries
    };

    /// Of all bodies of all ranks, n_entries each.
    std::vector<double> of_all_ranks() const;

    Communicator processes;
    std::vector<Structure::Body> bodies;
    std::vector<double> own; ///< what this rank found, zero elsewhere; n_entries of each body
    std::vector<std::size_t> watched; ///< bodies here that are not slack so far
    bool is_new = true;
  };
} // namespace taut

#endif
