// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_observer_h
#define taut_observer_h

#include <taut/base/archive_forward.h>
#include <taut/base/exceptions.h>
#include <taut/base/registry.h>
#include <taut/interface/constraints.h>
#include <taut/model/scene_bodies.h>
#include <taut/time/contact_measures.h>
#include <taut/time/residuals.h>
#include <taut/time/state.h>
#include <taut/time/step_costs.h>
#include <taut/time/step_report.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// A result that is one number: of a sliding contact, another link, a probe, or what an observer
  /// measures.
  struct NamedQuantity
  {
    std::string item, quantity;
    double value;
    std::string unit;
  };

  /// Values of the links of a scene, by their indices, the same on all ranks: where a scene is
  /// distributed, a rank has the rows of its own bodies alone.
  struct LinkValues
  {
    std::vector<double> force; ///< multiplier [N, N m]
    std::vector<double> gap;   ///< [m, rad]
  };

  /// Data of an accepted step for observers.
  struct StepView
  {
    const Scene &scene;
    const SceneBodies &structure;

    /// Its rows are those of the state. On several ranks, a rank may have those of its own bodies
    /// alone: links, and Constraints::of_contact(), have the values of all.
    const Constraints &constraints;
    const Reference &reference;
    const State &state;
    const Residuals &residuals;

    /// External forces of the bodies at its end, minus those of the reference [N, N m].
    const BodyVectors &loads;

    /// What the step tells, and measures of the contacts until its end.
    const StepReport &report;
    const ContactMeasures &measures;

    /// Displacement of each probe from the equilibrium without sliding contacts if the run starts
    /// from one; otherwise, and at rest without such contacts, from the undeformed place [m, rad].
    const std::vector<double> &probes;

    /// Force of each of the support_points() on its wire [N, N m].
    const std::vector<double> &supports;

    const LinkValues &links;

    /// Times of this rank until the step, without the output of the step.
    const StepCosts::Sums &costs;
  };

  /// Data of a run before the first record.
  struct RunView
  {
    const std::string &folder; ///< of the results, exists
    double interval;           ///< Output/Interval: least time between two lines of a table [s]
    const Communicator &communicator;
    bool resumes = false; ///< files continue from the checkpoint, see Observer::resume()
  };

  /**
   * Receives the start of a run and each accepted step, in order. An observer that is registered
   * with Register<Observer, ...> runs if a parameter file names it in Output/Observers.
   *
   * All ranks call each function together. An exception on any rank ends the run on all ranks. A
   * function that communicates throws on all ranks or on none (Communicator::agree). finish() does
   * not communicate, as other ranks may have ended.
   */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    /// Declares its entries, in a section of Output with its name.
    virtual void declare_parameters(dealii::ParameterHandler &) {}

    /// Names of its files in the folder of the results. Such files of earlier runs count as
    /// results, too.
    virtual std::vector<std::string> files() const { return {}; }

    /// Called once, before the first record() or resume().
    virtual void begin(const RunView &) {}

    /**
     * Stores in a checkpoint the data to continue after the last recorded step, with all files on
     * the disk. Only the data of the root are kept: other ranks have to send theirs to the root
     * first. An observer with files that cannot do this throws a UserError, before the first step
     * of a run with checkpoints.
     */
    virtual void save(OutputArchive &)
    {
      if (!files().empty())
        throw UserError("the observer that writes '" + files().front() +
                        "' stores no checkpoints: set Output/Checkpoint interval = 0, or give it "
                        "save() and resume()");
    }

    /// Called in place of the first record() of a run that continues from a checkpoint: reads on
    /// each rank the data that the root stored at this step, in the same order.
    virtual void resume(InputArchive &, const StepView &) {}

    virtual void record(const StepView &step) = 0;

    /// Called once after the last step, also if a run ends early or with an error.
    virtual void finish() {}

    /**
     * Its results so far, each one number: statistics.json has them in "observers", tables of
     * sweeps and studies know them by item and quantity. Names and their order are the same at all
     * times, also before begin(), when values do not count yet. It must not communicate; what the
     * root says counts. Sweeps and studies write no files: of the observers of the file, those with
     * quantities and without files() are in their runs.
     */
    virtual std::vector<NamedQuantity> quantities() const { return {}; }

    /// Called after finish(): writes the final report to the log. It must not communicate if the
    /// run @p failed, as other ranks may not know.
    virtual void report(std::ostream & /*log*/, bool /*failed*/) const {}
  };
} // namespace taut

#endif
