// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_simulation_h
#define taut_simulation_h

#include <taut/output/accuracy_report.h>
#include <taut/output/model_limits.h>
#include <taut/output/observer.h>
#include <taut/output/statistics.h>
#include <taut/simulation/observed_run.h>
#include <taut/simulation/parameters.h>

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  struct ScenePlaces;
  struct SharedParts;

  /**
   * Throws an EntryError on Output/Folder if a run could not write its results there, because it is
   * a file or holds those of another run; touches nothing. Worth asking before a large scene is
   * made. Called by all ranks together.
   */
  void check_results_folder(const Parameters &parameters,
                            const Communicator &processes = Communicator());

  /**
   * A scene on its way through time: what a parameter file says becomes bodies and constraints, a
   * SteppedMotion of these, and an ObservedRun with the observers that write the results.
   */
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
    double stepping_seconds() const { return observed ? observed->stepping_seconds() : 0.; }

  private:
    PartitionParameters choose_parts();
    bool has_time() const { return parameters.end_time > 0.; }
    void describe() const;
    void print_bodies() const;
    void print_links() const;
    StepperOptions stepper_options() const;
    void find_start();
    std::string names_of(const std::vector<char> &some) const;
    void report_linearised() const;
    void report_free_bodies() const;
    void find_rest_of_probes();
    void choose_scheme();
    std::vector<std::string> unused_scheme_entries() const;
    void prepare_results(bool resumes);
    void write_start(const ScenePlaces &places) const;
    void add_observers();
    std::unique_ptr<StepAccuracy> step_accuracy();
    int signal() const;
    void stop_before_start() const;
    void step_to_the_end();
    void finish(bool is_partial);
    void say_how_it_ended() const;
    RunDescription description(bool is_partial) const;

    const Parameters &parameters;
    std::ostream &log;
    const Communicator processes;
    const Scene model;
    std::string parts_reason; ///< why the parts are so many, if that was left to Taut
    SceneBodies bodies;
    std::vector<std::string> grounded_links; ///< at held ends of cables
    Constraints links;
    Statistics figures;
    std::vector<Observer *> guests;
    std::function<int()> stop_asked;

    // Of a run.
    std::unique_ptr<SteppedMotion> motion;
    std::unique_ptr<ObservedRun> observed;
    std::unique_ptr<AccuracyReport> accuracy;
    std::unique_ptr<ModelLimits> limits;
  };
} // namespace taut

#endif
