// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_stepped_motion_h
#define taut_stepped_motion_h

#include <taut/base/start.h>
#include <taut/time/choose_scheme.h>
#include <taut/time/contact_measures.h>
#include <taut/time/initial_state.h>
#include <taut/time/step_accuracy.h>
#include <taut/time/step_control.h>

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// Options of a motion; the defaults suit most systems.
  struct StepperOptions
  {
    double step = 1e-3;        ///< [s]
    StepParameters steps = {}; ///< fixed, or adaptive

    /// Time until which "automatic" follows moving constraints; 0: at the start only [s].
    double end = 0.;
    Start start = Start::equilibrium;

    /// "automatic" chooses by the constraints that act as rigid. Otherwise the name of a registered
    /// scheme, with values of its entries by path ("Moreau-Jean/Theta"), which "automatic" sets
    /// itself.
    std::string scheme = "automatic";
    std::map<std::string, std::string> scheme_entries = {};
    double restitution = 0.; ///< Newton's, only with "automatic", 0 to 1 [1]
    bool allow_unsuitable_scheme = false;

    SolverParameters solver = {};
  };

  /**
   * The motion of bodies under constraints. Use it for bodies with another owner, as those of a
   * scene; a program with a System uses a Stepper.
   *
   * Three calls prepare the motion, so that results can be reported before the next call fails: the
   * constructor finds the start, choose_scheme() the scheme, and prepare() sets up all parts for
   * steps. All ranks call each function together.
   */
  class SteppedMotion
  {
  public:
    /// @p structure and @p constraints are kept by reference. Throws the errors of
    /// find_initial_state().
    SteppedMotion(Structure &structure, Constraints &constraints, const StepperOptions &options);

    /// Throws UserError for a restitution that no constraint can have.
    void choose_scheme();

    /// For @p n_steps of length StepperOptions::step. Throws UserError for a scheme that is known
    /// to fail on a constraint, and for bodies without support.
    void prepare(long n_steps = std::numeric_limits<long>::max());

    /// Advances by one accepted step. Throws UserError with time and constraint if its certificate
    /// exceeds the contact tolerance. After any exception the motion is that before the step.
    void advance();

    /// True also for an unprepared motion, which stays at its start.
    bool is_finished() const { return !control || control->is_finished(); }

    /// True at multiples of StepperOptions::step.
    bool is_at_step() const { return control->is_at_step(); }
    long n_repeated() const { return control ? control->n_repeated() : 0; }

    const InitialState &start() const { return initial; }
    const Reference &reference() const { return initial.reference; }

    /// State after the last step, or at the start.
    const State &state() const { return stepper ? stepper->state() : initial.state; }
    const Certificate &certificate() const
    {
      return has_moved() ? stepper->certificate() : initial.certificate;
    }

    /// Coefficients of the last step; default values before the first step.
    const StepCoefficients &coefficients() const { return last; }
    bool has_moved() const { return stepper && stepper->n_steps_done() > 0; }

    /// Measures of the contacts so far.
    const ContactMeasures &measures() const { return contact_measures; }

    const Structure &bodies() const { return structure; }
    const Constraints &links() const { return constraints; }

    /// Name and entries of the scheme, the reason (empty: the user named it), and all in words.
    const SchemeChoice &choice() const { return chosen; }
    std::string scheme() const;
    std::string scheme_and_reason() const;

    /// Parts of a prepared motion.
    const TimeStepper &time_stepper() const { return *stepper; }

    /// Where the time of the steps goes; those of a prepared motion differ from those before.
    StepCosts &costs() { return stepper ? stepper->costs() : no_costs; }
    const StepCosts &costs() const { return stepper ? stepper->costs() : no_costs; }
    RunInSteps run_in_steps(long n_steps);

    /// For checkpoints, as in TimeStepper: @p state has the vectors of the bodies.
    void save(OutputArchive &archive);
    void load(InputArchive &archive, State state);

    /// Calls Substructure::load() of a body of this rank.
    void load_body(const std::size_t k, InputArchive &archive) { structure.load(k, archive); }

  private:
    const ContactResolution &resolution();

    Structure &structure;
    Constraints &constraints;
    const StepperOptions options;
    InitialState initial;
    ContactMeasures contact_measures;
    SchemeChoice chosen;
    std::unique_ptr<ContactResolution> resolved; ///< until the first step
    std::unique_ptr<TimeIntegrator> integrator;
    std::vector<LongestStep> longest_steps; ///< of constraints with dampers
    std::unique_ptr<TimeStepper> stepper;
    std::unique_ptr<StepControl> control;
    StepCoefficients last;
    StepCosts no_costs; ///< of a motion that is not prepared
  };
} // namespace taut

#endif
