// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_stepper_h
#define taut_stepper_h

#include <taut/base/start.h>
#include <taut/interface/system.h>
#include <taut/time/contact_measures.h>
#include <taut/time/initial_state.h>
#include <taut/time/step_control.h>

#include <map>
#include <memory>
#include <string>

namespace taut
{
  /// How a system moves through time; the defaults suit most.
  struct StepperOptions
  {
    double step = 1e-3;        ///< [s]
    StepParameters steps = {}; ///< fixed, or adaptive

    /// Until when "automatic" looks at the ways of moving constraints; 0: at their start only [s].
    double end = 0.;
    Start start = Start::equilibrium;

    /// "automatic" chooses by the constraints that act as rigid; otherwise the name of a registered
    /// scheme, with values of its entries by path ("Moreau-Jean/Theta"), which "automatic" sets
    /// itself.
    std::string scheme = "automatic";
    std::map<std::string, std::string> scheme_entries = {};
    double restitution = 0.; ///< Newton's, with "automatic" alone, 0 to 1 [1]
    bool allow_unsuitable_scheme = false;

    SolverParameters solver = {};
  };

  /**
   * Moves a system step by step, without a parameter file and without files of results:
   *
   *     Stepper stepper(system, options);
   *     while (stepper.time() < 1.)
   *       stepper.advance();
   *
   * All ranks of the system make it and call each function together.
   */
  class Stepper
  {
  public:
    /// @p system is kept by reference. Finds the start, linearises there the bodies that ask for it
    /// (see SlenderBody::linearised()) and chooses the scheme. Throws UserError for options that
    /// are not possible, if there is no equilibrium, or if a scheme is known to fail on a
    /// constraint.
    explicit Stepper(const System &system, const StepperOptions &options = StepperOptions());

    /// One step. Throws UserError, naming time and constraint, if its certificate misses the
    /// contact tolerance.
    void advance();

    double time() const { return stepper->state().time; }
    const State &state() const { return stepper->state(); }
    const Reference &reference() const { return stepper->reference(); }

    /// Of the last step; of the equilibrium before the first one.
    const Certificate &certificate() const;

    /// What the contacts did so far.
    const ContactMeasures &measures() const { return contact_measures; }

    // Of all functions below, a body or a constraint that the system did not have when the Stepper
    // was made, and a form that is not on its bodies, is a UserError.

    /// Multiplier of a constraint [N], and its gap between the bodies, negative where the spring of
    /// the constraint is compressed [m].
    double multiplier(std::size_t constraint) const;
    double gap(std::size_t constraint) const;

    /// From the undeformed system [m], and its rate [m/s].
    double displacement(const Displacement &form) const;
    double velocity(const Displacement &form) const;

    /// Displacement of a body from the undeformed system, one entry a DoF [m, rad]; empty on ranks
    /// that do not have it.
    std::vector<double> displacement(std::size_t body) const;

    /// Solves of Newton's method so far, for bodies that are not linear; otherwise 0.
    long n_newton_iterations() const { return stepper->n_newton_iterations(); }

    /// Name of the scheme with its parameters, and why it was chosen.
    const std::string &scheme() const { return scheme_description; }

  private:
    const TimeIntegrator &choose(const StepperOptions &options);
    std::size_t row(std::size_t constraint) const;

    const System &system;
    const std::size_t n_constraints; ///< of the system when this was made
    Structure structure; ///< its bodies, those linear that linearised() takes the place of
    Constraints constraints;
    std::unique_ptr<TimeIntegrator> integrator;
    std::string scheme_description;
    bool allow_unsuitable_scheme = false;
    std::vector<double> longest_steps; ///< of constraints with dampers [s]
    InitialState start;
    ContactMeasures contact_measures;
    std::unique_ptr<TimeStepper> stepper;
    std::unique_ptr<StepControl> control;
  };
} // namespace taut

#endif
