// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_observer_h
#define taut_observer_h

#include <taut/base/registry.h>
#include <taut/interface/constraints.h>
#include <taut/model/scene_bodies.h>
#include <taut/time/certificate.h>
#include <taut/time/contact_measures.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>

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
    /// from an equilibrium; otherwise from the undeformed position [m, rad].
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

    /// Called once, before the first record.
    virtual void begin(const RunView &) {}

    virtual void record(const StepView &step) = 0;

    /// Called once after the last step, also of a run that ends early or with an error.
    virtual void finish() {}
  };
} // namespace taut

#endif
