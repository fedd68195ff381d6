// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_stepper_h
#define taut_stepper_h

#include <taut/interface/system.h>
#include <taut/time/stepped_motion.h>

#include <string>
#include <vector>

namespace taut
{
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

    double time() const { return motion.state().time; }
    const State &state() const { return motion.state(); }
    const Reference &reference() const { return motion.reference(); }

    /// Of the last step; of the equilibrium before the first one.
    const Certificate &certificate() const { return motion.certificate(); }

    /// What the contacts did so far.
    const ContactMeasures &measures() const { return motion.measures(); }

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
    long n_newton_iterations() const { return motion.time_stepper().n_newton_iterations(); }

    /// Name of the scheme with its parameters, and why it was chosen.
    std::string scheme() const { return motion.scheme_and_reason(); }

    /// Without the system, for observers: see ObservedRun (simulation/observed_run.h).
    SteppedMotion &stepped() { return motion; }

  private:
    std::size_t row(std::size_t constraint) const;

    const System &system;
    const std::size_t n_constraints; ///< of the system when this was made
    Structure structure; ///< its bodies, those linear that linearised() takes the place of
    Constraints constraints;
    SteppedMotion motion;
  };
} // namespace taut

#endif
