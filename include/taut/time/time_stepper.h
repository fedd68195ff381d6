// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_time_stepper_h
#define taut_time_stepper_h

#include <taut/base/archive_forward.h>
#include <taut/time/balance_certificate.h>
#include <taut/time/certificate.h>
#include <taut/time/contact_conditions.h>
#include <taut/time/energy_gains.h>
#include <taut/time/integrator.h>
#include <taut/time/load_sampling.h>
#include <taut/time/local_error.h>
#include <taut/time/matrix_norms.h>
#include <taut/time/nonlinear_bodies.h>
#include <taut/time/solver_parameters.h>
#include <taut/time/state.h>
#include <taut/time/step_check.h>
#include <taut/time/step_equations.h>
#include <taut/time/turning_constraints.h>
#include <taut/time/velocity_projection.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * Advances the bodies and the multipliers by steps:
   *
   *     moving constraints -> history P^_k -> contact-free predictor -> N -> U_k -> certificate
   *     -> velocities, with schemes that project them.
   *
   * Everything is in increments, A dU = P^ + B N; ContactConditions says what the constraints ask
   * for. Where a body is not linear, Newton's method does so again and again, with the
   * complementarity problem solved exactly each time (N. H. Josephy, 1979).
   */
  class TimeStepper
  {
  public:
    /**
     * @p structure and @p constraints are kept by reference. @p at_rest says that the start is an
     * equilibrium, so that accelerations are zero; otherwise the first step is backward Euler,
     * unless the scheme needs no initial acceleration either.
     */
    TimeStepper(const Structure &structure, Constraints &constraints,
                const SolverParameters &parameters, const TimeIntegrator &integrator, double step,
                Reference reference, State start, bool at_rest);

    /// One step. Throws UserError, naming time and constraint, if the certificate misses the
    /// contact tolerance.
    void advance();

    /// Length of the steps to come [s].
    void set_step(double length);

    /**
     * Stores all that later steps read beside the vectors of the bodies, the same on all ranks;
     * then begins anew with factors, F and search, whose rounding depends on the steps before. So
     * does load(): a run that stores and one that goes on from there have the same bits. Called by
     * all ranks together.
     */
    void save(OutputArchive &archive);

    /// @p state has the vectors of the bodies.
    void load(InputArchive &archive, State state);

    /// Back to a state of before, as if nothing had happened since.
    void restore(const State &before);

    /// Of the last step, see LocalError. Called by all ranks together.
    double local_error()
    {
      return errors.measure(current, coefficients, step_before, forces.old_A);
    }

    /// True if the next step, of @p length [s], misses nothing of loads and given motions; see
    /// LoadSampling. Called by all ranks together.
    bool resolves_loads(double length, double reference_step, double tolerance)
    {
      return loads.is_resolved(current.time, length, reference_step, tolerance);
    }

    /**
     * Throws an EntryError if a moving elastic constraint acts as rigid where it is now, in a
     * scheme whose forces then ring; see ContactResolution. Called by all ranks together, after a
     * step.
     */
    void check_moving_contacts();

    const State &state() const { return current; }
    const Reference &reference() const { return reference_state; }
    const Certificate &certificate() const { return last; }

    /// Of the last step.
    const StepCoefficients &scheme() const { return coefficients; }
    long n_steps_done() const { return n_steps; }

    /// Solves of Newton's method so far; 0 if all bodies are linear and no constraint turns.
    long n_newton_iterations() const { return n_iterations; }
    bool is_linear() const { return bodies_are_linear && turning.empty(); }

    /// Form and size of the interface operator, for the log.
    std::string interface_description() const { return system->interface().description(); }
    InterfaceStatistics interface_statistics() const;

  private:
    void prepare(StepCoefficients c);
    template <typename Archive>
    void store(Archive &archive);
    void reset_caches(const std::vector<double> &largest_rates);
    void set_external_force(std::size_t k);
    void set_history(std::size_t k);
    void set_loads();
    void find_increments();
    void attempt(const std::function<void()> &work);
    void solve();
    void iterate();
    bool solve_by_newton();
    void set_nonlinear();
    void linearise();
    void check_turning() const;
    double set_guess();
    void project_velocities();
    void accept_increments();
    void accept(std::size_t k, std::size_t begin, std::size_t end);
    void measure_balance(const BalanceCertificate::SetRows &set_rows = {});
    bool is_cancellation() const;
    void start_balance();
    void hold_quasi_static_dofs();
    void certify();
    bool refine();
    void certify_rows();

    const Structure &structure;
    Constraints &constraints;
    const SolverParameters parameters;
    const TimeIntegrator &integrator;
    double step, step_before = 0.;
    const Reference reference_state;
    State current;
    Certificate last;

    StepCoefficients coefficients;
    bool first_step_is_backward_euler;
    long n_steps = 0;
    long n_iterations = 0; ///< of Newton's method, of all steps
    double segment_start;  ///< time since which steps have this length
    long n_in_segment = 0;

    /// What restore() goes back to beside the state.
    struct Sizes
    {
      PerKind motion;
      GapTracker::Sizes of_gaps;
      std::vector<std::vector<double>> courses;
      std::vector<double> rates;
    };
    Sizes before_step;

    std::unique_ptr<StepEquations> system;
    InterfaceStatistics earlier_systems; ///< of those before
    TurningConstraints turning;
    ContactConditions conditions;
    NonlinearBodies nonlinear;
    LoadSampling loads;
    LocalError errors;
    EnergyGains energy_gains;
    bool tangents_are_kept = false; ///< from step to step
    bool bodies_are_linear = true;  ///< those of all ranks
    BalanceCertificate balance;
    double own_balance = 0.; ///< of this rank
    StepCheck check;
    std::unique_ptr<VelocityProjection> projection; ///< of schemes with one

    StepForces forces;
    BodyVectors right_hand_side;        ///< then the increments
    BodyVectors lift;                   ///< increments of moving supports
    std::vector<double> work_v, work_a; ///< as long as the longest body
    std::vector<double> damping_of_tile, inertia_of_tile;
    std::vector<double> work_rows;
  };
} // namespace taut

#endif
