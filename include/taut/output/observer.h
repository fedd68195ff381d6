// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_observer_h
#define taut_observer_h

#include <taut/interface/contact_rows.h>
#include <taut/model/scene_bodies.h>
#include <taut/time/certificate.h>
#include <taut/time/contact_measures.h>
#include <taut/time/integrator.h>
#include <taut/time/state.h>

#include <vector>

namespace taut
{
  /// What an observer sees of an accepted step.
  struct StepView
  {
    const Scene &scene;
    const SceneBodies &structure;
    const ContactRows &rows;
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

  /// Receives the start of a run and each accepted step, in order.
  class Observer
  {
  public:
    virtual ~Observer() = default;
    virtual void record(const StepView &step) = 0;

    /// Called once after the last step, also of a run that ends early or with an error.
    virtual void finish() {}
  };
} // namespace taut

#endif
