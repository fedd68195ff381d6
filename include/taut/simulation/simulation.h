// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_simulation_h
#define taut_simulation_h

#include <taut/output/observer.h>
#include <taut/output/statistics.h>
#include <taut/simulation/observed_run.h>
#include <taut/simulation/parameters.h>

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class AccuracyReport;
  class ModelLimits;
  class RestFigures;
  struct ScenePlaces;
  struct SharedParts;
  class StepAccuracy;

  /// Throws an EntryError on Output/Folder if a run cannot write its results there: it is a file,
  /// has results of another run, or another run writes there now. Changes nothing. Use it before
  /// constructing a large scene. Called by all ranks together.
  void check_results_folder(const Parameters &parameters,
                            const Communicator &processes = Communicator());

  /// A run of a scene: builds bodies and constraints from a parameter file, a Motion of
  /// these, and an ObservedRun with the observers that write the results.
  class Simulation
  {
  public:
    /**
     * @p parameters is kept by reference; messages go to @p log. All ranks of @p processes call
     * each function together, with the same parameters; the root writes the results. @p shared has
     * parts of earlier runs that are not made again, and takes parts for later runs; the results
     * are the same.
     */
    Simulation(const Parameters &parameters, std::ostream &log,
               const Communicator &processes = Communicator(), SharedParts *shared = nullptr);
    ~Simulation();

    /// Adds an observer of the start and each step, called after those that write the results; kept
    /// by reference.
    void observe(Observer &observer) { guests.push_back(&observer); }

    /// Each rank calls @p asked after each step; a result other than 0 on any rank is the signal to
    /// end the run. For taut::interruption, or a hook of the caller.
    void stop_if(std::function<int()> asked) { stop_asked = std::move(asked); }

    /// Runs to the end and writes the results. Throws UserError, and Interrupted after a request to
    /// stop. In both cases the results up to the last step are written and marked as partial;
    /// before the first step nothing is written.
    void run();

    /// Does all work before the first step and prints the scene; writes nothing. Throws UserError.
    void check();

    const Scene &scene() const { return model; }
    const SceneBodies &structure() const { return bodies; }
    const Constraints &constraints() const { return links; }

    /// Statistics of the steps so far.
    const Statistics &statistics() const { return figures; }

    /// Quantities of the observers at the end of the run; before it, of the observers that it will
    /// have.
    std::vector<NamedQuantity> observed_quantities() const;

    /// Of the run so far, as statistics.json has them.
    std::vector<Warning> warnings() const;

    /// After a run in time: what lies between its steps, unseen, in words; empty: nothing.
    std::string what_steps_miss() const;

    /// Number of steps that fit into the time of the run.
    long n_steps() const;

    /// Seconds in the loop over the steps, without output.
    double stepping_seconds() const { return observed ? observed->stepping_seconds() : 0.; }

  private:
    PartitionParameters choose_parts();
    Constraints make_constraints() const;
    bool has_time() const { return parameters.end_time > 0.; }
    void describe() const;
    void print_bodies() const;
    void print_links() const;
    StepperOptions stepper_options() const;
    void find_start();
    std::string names_of(const std::vector<char> &some) const;
    void report_repeated_joints(const std::string &names) const;
    void report_linearised() const;
    void report_free_bodies() const;
    void find_rest();
    std::vector<double> heights_at_rest() const;
    void choose_scheme();
    std::vector<std::string> unused_scheme_entries() const;
    void prepare_results(bool resumes);
    void keep_forces_at_rest(const Scene &scene, const std::vector<double> &of_links);
    void write_start(const ScenePlaces &places, const std::vector<double> &heights,
                     const std::vector<double> &forces, const std::vector<double> &gaps) const;
    void write_droppers(const ScenePlaces &places, const std::vector<double> &heights) const;
    void add_observers();
    void make_accuracy_report();
    std::vector<Warning> unseen_features() const;
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
    std::string parts_reason; ///< reason for the number of parts, if automatic
    SceneBodies bodies;
    std::vector<std::string> grounded_links; ///< at held ends of cables
    Constraints links;
    Statistics figures;
    std::vector<Observer *> guests;
    std::function<int()> stop_asked;

    // Of a run.
    std::unique_ptr<Motion> motion;
    std::unique_ptr<ObservedRun> observed;
    BodyVectors rest;                             ///< see find_rest() [m, rad]
    std::map<std::string, double> forces_at_rest; ///< of droppers between wires, on the root [N]
    std::unique_ptr<AccuracyReport> accuracy;
    std::unique_ptr<ModelLimits> limits;
    std::unique_ptr<RestFigures> at_rest; ///< of a run without time
    std::vector<NamedQuantity> measured;  ///< by the observers, at the end
  };
} // namespace taut

#endif
