// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_time_stepper_h
#define taut_time_stepper_h

#include <taut/base/archive_forward.h>
#include <taut/time/certificate.h>
#include <taut/time/energy_gains.h>
#include <taut/time/integrator.h>
#include <taut/time/load_sampling.h>
#include <taut/time/local_error.h>
#include <taut/time/matrix_norms.h>
#include <taut/time/nonlinear_step.h>
#include <taut/time/solver_parameters.h>
#include <taut/time/state.h>
#include <taut/time/step.h>
#include <taut/time/step_clock.h>
#include <taut/time/velocity_projection.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * Advances the bodies and the multipliers by steps. A step
   *
   *     places the constraints that slide            Constraints::follow(), update()
   *     finds multipliers and increments, accepts
   *     and certifies them                           Step
   *     projects the velocities, with some schemes   VelocityProjection.
   *
   * With nonlinear bodies or turning constraints, NonlinearStep iterates to the increments.
   */
  class TimeStepper
  {
  public:
    /// @p structure and @p constraints are kept by reference. @p at_rest: the start is an
    /// equilibrium with zero accelerations. Otherwise the first step is backward Euler, unless the
    /// scheme needs no initial acceleration.
    TimeStepper(const Structure &structure, Constraints &constraints,
                const SolverParameters &parameters, const TimeIntegrator &integrator, double length,
                Reference reference, State start, bool at_rest);

    /// Advances by one step. Throws UserError with time and constraint if the certificate exceeds
    /// the contact tolerance. After any exception the motion is that before the step.
    void advance();

    /// Takes the last step back, as if nothing had happened since.
    void take_back();

    /// The state before the last step, without the vectors of the bodies.
    const SharedState &before() const { return old.state; }

    /// From now on a step throws an EntryError if a moving elastic constraint acts as rigid in its
    /// place and the forces of the scheme then ring, see ContactResolution.
    void refuse_rigid_moving_contacts() { refuses_rigid = true; }

    /// Length of the steps to come [s].
    void set_step(const double length) { clock.set_step(length, current.time); }

    /// Stores all data of later steps but the vectors of the bodies, equal on all ranks. Then, like
    /// load(), resets factors, F and search, whose rounding depends on earlier steps: a run that
    /// stores and a run that continues from there have the same bits. Called by all ranks together.
    void save(OutputArchive &archive);

    /// @p state has the vectors of the bodies.
    void load(InputArchive &archive, State state);

    /// Local error of the last step, see LocalError. Called by all ranks together.
    double local_error()
    {
      return errors.measure(current, coefficients, clock.step_before(),
                            step.history().forces().old_A);
    }

    /// True if the next step, of @p length [s], resolves loads and prescribed motions, see
    /// LoadSampling. Called by all ranks together.
    bool resolves_loads(double length, double reference_step, double tolerance)
    {
      return loads.is_resolved(current.time, length, reference_step, tolerance);
    }

    const State &state() const { return current; }
    const Reference &reference() const { return reference_state; }

    /// External forces of the state minus those of the reference [N, N m].
    const BodyVectors &external_forces() const { return step.history().forces().P; }
    const Certificate &certificate() const { return last; }

    /// Coefficients of the last step.
    const StepCoefficients &scheme() const { return coefficients; }
    long n_steps_done() const { return clock.n_steps(); }

    /// Newton iterations so far; 0 if all bodies are linear and no constraint turns.
    long n_newton_iterations() const { return nonlinear.n_iterations(); }
    bool is_linear() const { return nonlinear.is_linear(); }

    /// Form and size of the interface operator, for the log.
    std::string interface_description() const { return step.equations().interface().description(); }
    InterfaceStatistics interface_statistics() const { return step.interface_statistics(); }

    /// Rigid joints that repeated each other in the last step, see RepeatedRows; iterative solves
    /// do not find them.
    std::vector<std::size_t> repeated_joints() const
    {
      return step.equations().repeated_rows().all_partners();
    }

    /// Where the time of the steps goes.
    StepCosts &costs() { return step.costs(); }
    const StepCosts &costs() const { return step.costs(); }

  private:
    void prepare(StepCoefficients c);
    template <typename Archive>
    void store(Archive &archive);
    void reset_caches(const std::vector<double> &largest_rates);
    void keep_old();
    void step_on();
    void begin_step(double end);
    void attempt(const std::function<void()> &work);
    void solve();
    void face_new_directions();
    void project_velocities();
    void measure_energy();
    void start_balance();
    void hold_quasi_static_dofs();
    void check_moving_contacts();

    const Structure &structure;
    Constraints &constraints;
    const SolverParameters parameters;
    const Reference reference_state;
    State current;
    Certificate last;
    StepClock clock;
    StepCoefficients coefficients; ///< of the last step

    bool refuses_rigid = false;

    /// What take_back() needs beside the vectors of the bodies, which the history has.
    struct Old
    {
      SharedState state;
      Certificate certificate;
      PerKind motion;
      GapTracker::Sizes of_gaps;
      std::vector<std::vector<double>> courses;
      std::vector<double> rates;
    };
    Old old;

    NonlinearStep nonlinear;
    Step step;
    LoadSampling loads;
    LocalError errors;
    EnergyGains energy_gains;
    std::unique_ptr<VelocityProjection> projection; ///< for schemes with a velocity projection
  };
} // namespace taut

#endif
