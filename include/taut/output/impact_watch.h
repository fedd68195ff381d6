// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_impact_watch_h
#define taut_impact_watch_h

#include <taut/output/observer.h>

#include <iosfwd>
#include <vector>

namespace taut
{
  /**
   * Detects simultaneous impacts with restitution, in one step at contacts that share a body.
   * Newton's law then holds for all of them together; successive impacts may end differently.
   *
   * An impact has a force far above that of the step before, and one of the impacts had a closing
   * gap. Two rigid unilateral constraints share a body if both act on it; for lumped masses, on the
   * same DoF.
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
    const Constraints *rows = nullptr; ///< of the last step
    std::vector<double> rate, force;   ///< of each row after the last step [m/s, N]
    double largest[2] = {0., 0.};      ///< largest rate of a displacement and of a rotation so far
    bool is_running = false;           ///< the start was recorded
    long n_steps = 0;                  ///< number of such steps
    double first = 0.;                 ///< time of the first such step [s]
    std::string names;                 ///< names of its constraints
  };
} // namespace taut

#endif
