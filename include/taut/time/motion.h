// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_motion_h
#define taut_motion_h

#include <taut/base/archive_forward.h>
#include <taut/base/start.h>
#include <taut/time/contact_measures.h>
#include <taut/time/energy_account.h>
#include <taut/time/initial_state.h>
#include <taut/time/integrator.h>
#include <taut/time/step_costs.h>
#include <taut/time/step_parameters.h>
#include <taut/time/step_report.h>

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class ContactResolution;
  struct LongestStep;
  struct UnseenFeature;
  struct InterfaceStatistics;

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
   * The motion of bodies under constraints: their state, the scheme, the step, and the control of
   * its length. Use it for bodies with another owner, as those of a scene; a program with a System
   * uses a Stepper.
   *
   * Three calls prepare the motion, so that results can be reported before the next call fails: the
   * constructor finds the start, choose_scheme() the scheme, and prepare() sets up all parts for
   * steps. A step then
   *
   *     places the constraints that slide            Constraints::follow(), update()
   *     finds multipliers and increments, accepts
   *     and certifies them                           Step
   *     projects the velocities, with some schemes   VelocityProjection
   *     and tells what it did                        StepReport, EnergyAccount, ContactMeasures.
   *
   * With nonlinear bodies or turning constraints, NonlinearStep iterates to the increments.
   * StepControl says how long the next step is, and takes back one that is too long. All ranks call
   * each function together.
   */
  class Motion
  {
  public:
    /// @p structure and @p constraints are kept by reference. Throws the errors of
    /// find_initial_state().
    Motion(Structure &structure, Constraints &constraints, const StepperOptions &options);
    ~Motion();

    /// Throws UserError for a restitution that no constraint can have.
    void choose_scheme();

    /// For @p n_steps of length StepperOptions::step. Throws UserError for a scheme that is known
    /// to fail on a constraint, and for bodies without support.
    void prepare(long n_steps = std::numeric_limits<long>::max());

    /// A prepared motion from a start of the user's own, with a scheme of the user's own. For
    /// constraints with dampers, @p longest_steps are those of ContactResolution.
    Motion(Structure &structure, Constraints &constraints, const StepperOptions &options,
           InitialState start, std::shared_ptr<const TimeIntegrator> scheme,
           long n_steps = std::numeric_limits<long>::max());
    Motion(Structure &structure, Constraints &constraints, const StepperOptions &options,
           InitialState start, std::shared_ptr<const TimeIntegrator> scheme, long n_steps,
           std::vector<LongestStep> longest_steps);

    /// The prepared @p other motion once more from its start, in @p n_steps of other lengths. The
    /// constraints move with this one from now on.
    Motion(Motion &other, double step, const StepParameters &steps,
           std::vector<LongestStep> longest_steps, long n_steps);

    /// Frees the factors, which take most of the memory; a further step makes them anew.
    void discard_factors();

    /// Advances by one accepted step. Throws UserError with time and constraint if its residuals
    /// exceeds the contact tolerance. After any exception the motion is that before the step.
    void advance();

    /// True also for an unprepared motion, which stays at its start.
    bool is_finished() const;

    /// True at multiples of StepperOptions::step.
    bool is_at_step() const;
    long n_repeated() const;

    const InitialState &start() const { return *initial; }
    const Reference &reference() const { return initial->reference; }

    /// State after the last step, or at the start, and its residuals.
    const State &state() const;
    const Residuals &residuals() const;

    /// What the last step tells; empty before the first step.
    const StepReport &report() const;

    /// External forces of the bodies of this rank at the present time, minus those of the
    /// reference [N, N m].
    const BodyVectors &loads() const;
    bool has_moved() const;

    /// Measures of the contacts so far.
    const ContactMeasures &measures() const { return contact_measures; }

    const StepperOptions &settings() const { return options; }
    const Structure &bodies() const { return structure; }
    const Constraints &links() const { return constraints; }

    /// Name and entries of the scheme, the reason (empty: the user named it), and all in words.
    const SchemeChoice &choice() const { return chosen; }
    std::string scheme() const;
    std::string scheme_and_reason() const;

    // Of a prepared motion:

    /// For each constraint with a damper the longest step in a contact; empty: any.
    const std::vector<LongestStep> &longest_steps_in_contacts() const { return longest_steps; }

    /// Newton iterations so far; 0 if all bodies are linear and no constraint turns.
    long n_newton_iterations() const;
    bool is_linear() const;

    /// Form and size of the interface operator, for the log.
    std::string interface_description() const;
    InterfaceStatistics interface_statistics() const;

    /// Numbers of rigid joints that repeated each other in the last step, see RepeatedRows;
    /// iterative solves do not find them.
    std::vector<std::size_t> repeated_joints() const;

    /// Where the time of the steps goes; those of a prepared motion differ from those before.
    StepCosts &costs();
    const StepCosts &costs() const;

    /// Stores all data of later steps but the vectors of the bodies, equal on all ranks. Then, like
    /// load(), resets factors, F and search, whose rounding depends on earlier steps: a run that
    /// stores and a run that continues from there have the same bits.
    void save(OutputArchive &archive);

    /// @p state has the vectors of the bodies.
    void load(InputArchive &archive, State state);

    /// Calls Substructure::load() of a body of this rank.
    void load_body(const std::size_t k, InputArchive &archive) { structure.load(k, archive); }

    /// What steps of StepperOptions::step do not see of loads, prescribed motions and heights; no
    /// name: nothing, or the number of steps is not known. The first call searches. Called by all
    /// ranks together.
    const UnseenFeature &unseen_feature();

    // For StepControl:

    /// Makes one step of this length [s], certified. After any exception the motion is that before.
    void try_step(double length);

    /// Takes the last step back, as if nothing had happened since.
    void take_back();

    /// The rows before the last step.
    const RowStates &rows_before() const;

    /// Local error of the last step, see LocalError.
    double local_error();

    /// True if the next step, of @p length [s], resolves loads and prescribed motions, see
    /// LoadSampling.
    bool resolves_loads(double length, double tolerance);

  private:
    /// The parts of a prepared motion.
    struct Parts;

    Motion(Structure &structure, Constraints &constraints, const StepperOptions &options,
           std::shared_ptr<const InitialState> start, std::shared_ptr<const TimeIntegrator> scheme,
           long n_steps, std::vector<LongestStep> longest_steps);

    const ContactResolution &resolution();
    void begin(long n_steps);
    void prepare_method(const TimeIntegrator &scheme, const StepCoefficients &c);
    void start_balance();
    void hold_quasi_static_dofs();
    void keep();
    void step_on();
    void begin_step();
    template <typename Work>
    void attempt(const Work &work);
    void solve();
    void project_velocities();
    void check_moving_contacts();
    template <typename Archive>
    void store(Archive &archive);
    void reset_caches(const std::vector<double> &largest_rates);

    Structure &structure;
    Constraints &constraints;
    const StepperOptions options;
    std::shared_ptr<const InitialState> initial; ///< which another Motion may have, too
    EnergyAccount energy;
    ContactMeasures contact_measures;
    SchemeChoice chosen;
    std::unique_ptr<ContactResolution> resolved; ///< until the first step
    std::shared_ptr<const TimeIntegrator> integrator;
    std::shared_ptr<const TimeIntegrator> first_scheme; ///< of the first step
    std::vector<LongestStep> longest_steps;             ///< of constraints with dampers
    std::unique_ptr<Parts> parts;
    std::unique_ptr<UnseenFeature> unseen;          ///< after the first search
    std::vector<std::vector<double>> first_courses; ///< of sliding rows at the start
    const StepReport no_report;                     ///< before the first step
    StepCosts no_costs;                             ///< of a motion that is not prepared
  };
} // namespace taut

#endif
