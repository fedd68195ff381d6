// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_impact_watch_h
#define taut_impact_watch_h

#include <taut/output/observer.h>

#include <iosfwd>
#include <vector>

namespace taut
{
  /**
   * Notes impacts with restitution that happen in one step at contacts that share a body. Newton's
   * law then holds for all of them at once; impacts one after the other may end otherwise.
   *
   * Rigid unilateral constraints are struck in a step if their forces are far above those of the
   * step before, and one of them was closing. Two share a body if both move one, or of
   * lumped masses the same DoF.
   */
  class ImpactWatch : public Observer
  {
  public:
    void begin(const RunView &run) override { processes = run.communicator; }
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    /// One line if there were such steps.
    void report(std::ostream &log, bool failed) const override;

  private:
    template <typename Archive>
    void store(Archive &archive);
    std::vector<std::size_t> struck(const StepView &step) const;
    std::vector<std::size_t> sharing(const StepView &step,
                                     const std::vector<std::size_t> &constraints) const;

    Communicator processes;
    std::vector<double> rate, force; ///< of each constraint after the step before [m/s, N]
    double largest[2] = {0., 0.};    ///< rate of a displacement or a rotation so far
    bool is_running = false;         ///< the start was recorded
    long n_steps = 0;                ///< with such impacts
    double first = 0.;               ///< time of the first one [s]
    std::string names;               ///< of its constraints
  };
} // namespace taut

#endif
