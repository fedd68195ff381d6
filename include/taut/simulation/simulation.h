// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_simulation_h
#define taut_simulation_h

#include <taut/interface/constraints.h>
#include <taut/output/model_limits.h>
#include <taut/output/observer.h>
#include <taut/output/reactions.h>
#include <taut/output/statistics.h>
#include <taut/simulation/parameters.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  class ObserverList;
  class StepAccuracy;
  class StepControl;
  class TimeStepper;
  struct Checkpoint;
  struct InitialState;
  struct ScenePlaces;
  struct SharedParts;

  /**
   * Throws an EntryError on Output/Folder if a run could not write its results there, because it is
   * a file or holds those of another run; touches nothing. Worth asking before a large scene is
   * made. Called by all ranks together.
   */
  void check_results_folder(const Parameters &parameters,
                            const Communicator &processes = Communicator());

  /// A scene on its way through time: reads like the algorithm on paper.
  class Simulation
  {
  public:
    /**
     * @p parameters is kept by reference; what is said goes to @p log. All ranks of @p processes
     * call each function together, with the same parameters; the root writes the results. What
     * earlier runs left in @p shared is not made again, and later ones find there what this one
     * makes; its results are the same.
     */
    Simulation(const Parameters &parameters, std::ostream &log,
               const Communicator &processes = Communicator(), SharedParts *shared = nullptr);
    ~Simulation();

    /// Adds an observer of the start and of each step, called after those that write the results;
    /// kept by reference.
    void observe(Observer &observer) { guests.push_back(&observer); }

    /// @p asked is called on each rank after each step; what is not 0 on any of them is the signal
    /// that ends the run there. For taut::interruption, or a hook of the caller's own.
    void stop_if(std::function<int()> asked) { stop_asked = std::move(asked); }

    /**
     * Runs to the end and writes the results. Throws UserError, and Interrupted if it was asked to
     * stop. If it ends early in one of these ways, the results up to the last step are written and
     * marked as partial; nothing is written if it ends before the first one.
     */
    void run();

    /// Everything up to the first step, and the scene in tables; writes nothing. Throws UserError.
    void check();

    const Scene &scene() const { return model; }
    const SceneBodies &structure() const { return bodies; }
    const Constraints &constraints() const { return links; }

    /// Of the steps so far.
    const Statistics &statistics() const { return figures; }

    /// Steps of a run: those that fit into its time.
    long n_steps() const;

    /// Seconds that the loop over the steps took, without output.
    double stepping_seconds() const { return seconds; }

  private:
    void describe() const;
    RunDescription description(bool is_partial) const;
    void find_start();
    void report_linearised(const InitialState &found) const;
    void report_free_bodies() const;
    void find_rest_of_probes();
    const TimeIntegrator &choose_integrator();
    void keep_scheme(const TimeIntegrator &integrator, std::vector<std::string> unused);
    void write_start(const ScenePlaces &places) const;
    StepView view(const State &state, const Certificate &certificate) const;
    void update_probes(const State &state);
    void stop_before_start();
    void print_cost(const TimeStepper &stepper, double until, double all) const;
    void advance(TimeStepper &stepper, const ObserverList &observers);
    void prepare_step_check(const TimeIntegrator &integrator);
    void check_steps();
    void find_checkpoint();
    void check_origin(const Checkpoint &checkpoint) const;
    void save_checkpoint(TimeStepper &stepper, StepControl &control, const ObserverList &observers);
    void resume(TimeStepper &stepper, StepControl &control, const ObserverList &observers);
    State restored_state();
    void show(const ObserverList &observers, const State &state, const Certificate &certificate);
    void add_guests(ObserverList &observers) const;
    void on_root(const std::function<void()> &work) const;
    PartitionParameters choose_parts();

    const Parameters &parameters;
    std::ostream &log;
    const Communicator processes;
    const Scene model;
    std::string parts_reason; ///< why the parts are so many, if that was left to Taut
    SceneBodies bodies;
    std::vector<std::string> grounded_links; ///< at held ends of cables
    Constraints links;

    Reference reference;
    State start;
    Certificate start_certificate;
    bool keeps_directions = false; ///< links that would turn do not
    std::vector<std::vector<Term>> probe_terms;
    std::vector<double> probe_rest, probe_values;
    Reactions reactions;
    Statistics figures;
    std::unique_ptr<ModelLimits> limits; ///< of a run
    std::vector<Observer *> guests;
    std::unique_ptr<TimeIntegrator> chosen_integrator;
    std::vector<double> longest_steps; ///< of links with dampers [s]
    std::unique_ptr<ContactMeasures> measures;
    std::unique_ptr<StepAccuracy> accuracy;  ///< of runs whose steps are checked
    StepCoefficients coefficients;           ///< of the last step
    std::string scheme;                      ///< with its parameters
    std::vector<std::string> unused_entries; ///< of other schemes, with their values
    double seconds = 0.;
    std::shared_ptr<const Checkpoint>
        checkpoint;              ///< that the run goes on from; none: from the start
    double next_checkpoint = 0.; ///< [s]
    std::function<int()> stop_asked;
    int stop_signal = 0; ///< the same on all ranks; 0: go on
  };
} // namespace taut

#endif
