// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_stepper_h
#define taut_stepper_h

#include <taut/base/lasting.h>
#include <taut/interface/system.h>
#include <taut/time/motion.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * Moves a system step by step, without a parameter file or files of results:
   *
   *     Stepper stepper(system, options);
   *     while (stepper.time() < 1.)
   *       stepper.advance();
   *
   * All ranks of the system construct it and call each function together.
   */
  class Stepper
  {
  public:
    /// @p system is kept by reference. Finds the start, linearises bodies on request there (see
    /// SlenderBody::linearised()) and chooses the scheme. Throws UserError for impossible options,
    /// without an equilibrium, or if a scheme is known to fail on a constraint.
    explicit Stepper(Lasting<System> system, const StepperOptions &options = StepperOptions());

    /// Advances by one step. Throws UserError with time and constraint if its residuals exceeds
    /// the contact tolerance, and what bodies, loads and geometries throw. After any exception the
    /// motion is that before the step, or where a step is divided, before its last part.
    void advance();

    double time() const { return motion.state().time; }
    const State &state() const { return motion.state(); }
    const Reference &reference() const { return motion.reference(); }

    /// Residuals of the last step, or of the equilibrium before the first step.
    const Residuals &residuals() const { return motion.residuals(); }

    /// Measures of the contacts so far.
    const ContactMeasures &measures() const { return motion.measures(); }

    // Functions below throw UserError for a body or constraint that the system did not have when
    // the Stepper was made, and for forms on other bodies.

    /// Multiplier of a constraint [N]; gap of its bodies, negative if its spring is compressed [m].
    double multiplier(std::size_t constraint) const;
    double gap(std::size_t constraint) const;

    /// Displacement from the undeformed system [m], and its rate [m/s].
    double displacement(const Displacement &form) const;
    double velocity(const Displacement &form) const;

    /// Displacement of a body from the undeformed system by DoFs [m, rad]; empty on other ranks.
    std::vector<double> displacement(std::size_t body) const;

    /// Newton iterations so far, for nonlinear bodies; otherwise 0.
    long n_newton_iterations() const { return motion.n_newton_iterations(); }

    /// Name of the scheme with its parameters, and why it was chosen.
    std::string scheme() const { return motion.scheme_and_reason(); }

    /// The motion without the system, for observers: see ObservedRun (simulation/observed_run.h).
    Motion &stepped() { return motion; }

  private:
    std::size_t row(std::size_t constraint) const;

    const System &system;
    const std::size_t n_constraints; ///< of the system at construction
    Structure structure;             ///< bodies of the system, or their linearised() ones
    Constraints constraints;
    Motion motion;
  };
} // namespace taut

#endif
