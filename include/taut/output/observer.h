// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_observer_h
#define taut_observer_h

#include <taut/base/archive_forward.h>
#include <taut/base/exceptions.h>
#include <taut/base/registry.h>
#include <taut/interface/constraints.h>
#include <taut/model/scene_bodies.h>
#include <taut/time/certificate.h>
#include <taut/time/contact_measures.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// What an observer sees of an accepted step.
  struct StepView
  {
    const Scene &scene;
    const SceneBodies &structure;
    const Constraints &constraints;
    const Reference &reference;
    const State &state;
    const Certificate &certificate;

    /// The scheme of the step, and what the contacts did until its end.
    const StepCoefficients &scheme;
    const ContactMeasures &measures;

    /// Displacement of each probe from the equilibrium without sliding contacts, if the run starts
    /// from one; otherwise, and at rest with no such contact, from the undeformed place [m, rad].
    const std::vector<double> &probes;

    /// Force of each of the support_points() on its wire [N, N m].
    const std::vector<double> &supports;
  };

  /// What an observer knows of a run before its first record.
  struct RunView
  {
    const std::string &folder; ///< of the results, made
    double interval;           ///< Output/Interval: least time between two lines of a table [s]
    const Communicator &communicator;
    bool resumes = false; ///< its files go on where the checkpoint says, see Observer::resume()
  };

  /**
   * Receives the start of a run and each accepted step, in order. An observer that is registered
   * with Register<Observer, ...> runs if a parameter file names it in Output/Observers.
   *
   * All ranks call each function together. An exception on any rank ends the run on all; a function
   * that communicates throws on all ranks or on none (Communicator::agree). finish() does not
   * communicate: other ranks may not be there any more.
   */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    /// Declares its entries, in a section of Output that has its name.
    virtual void declare_parameters(dealii::ParameterHandler &) {}

    /// Names of the files that it writes into the folder of the results: those of an earlier run
    /// are results, too.
    virtual std::vector<std::string> files() const { return {}; }

    /// Called once, before the first record or resume().
    virtual void begin(const RunView &) {}

    /**
     * Stores in a checkpoint what it needs to go on after the last step that was recorded; files
     * are to be on the disk until there. What the root stores is kept; what other ranks know that
     * it does not has to be sent to it first. An observer with files that does not know how throws
     * a UserError, before the first step of a run with checkpoints.
     */
    virtual void save(OutputArchive &)
    {
      if (!files().empty())
        throw UserError("the observer that writes '" + files().front() +
                        "' stores no checkpoints: set Output/Checkpoint interval = 0, or give it "
                        "save() and resume()");
    }

    /// Instead of the first record of a run that goes on from a checkpoint: reads on each rank what
    /// the root stored at this step, in the same order.
    virtual void resume(InputArchive &, const StepView &) {}

    virtual void record(const StepView &step) = 0;

    /// Called once after the last step, also of a run that ends early or with an error.
    virtual void finish() {}

    /// Called after finish(): says in the log what there is to say at the end. Nothing communicates
    /// if the run @p failed, which other ranks may not have seen.
    virtual void report(std::ostream & /*log*/, bool /*failed*/) const {}
  };
} // namespace taut

#endif
