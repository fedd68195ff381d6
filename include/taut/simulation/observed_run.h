// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_observed_run_h
#define taut_observed_run_h

#include <taut/output/observer.h>
#include <taut/time/stepper.h>

#include <chrono>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class Checkpoints;
  class Reactions;

  /**
   * Steps with observers. Use it in a program with tables, fields, statistics or checkpoints of a
   * Stepper:
   *
   *     ObservedRun run(stepper, "results");
   *     Statistics statistics({}, run.scene(), run.constraints());
   *     run.observe(statistics);
   *     run.begin();
   *     while (run.time() < 1.)
   *       run.advance();
   *     run.finish();
   *
   * Observers see a System as a scene with probes only: data about items of a scene, as supports,
   * wires and contacts of surfaces, are empty. All ranks call each function together, except
   * finish() after an error.
   */
  class ObservedRun
  {
  public:
    /// @p stepper is kept by reference and steps only through this object from now on. The
    /// @p folder of the results is made; @p interval is Output/Interval, for all observers [s].
    ObservedRun(Stepper &stepper, const std::string &folder, double interval = 0.);

    /// For a scene, at its start; the references are kept. The folder is not made.
    ObservedRun(Motion &motion, const Scene &scene, const SceneBodies &structure,
                const std::string &folder, double interval);
    ~ObservedRun();

    /// Adds a probe before the observers with a column for it: displacement or rotation of a form,
    /// from the start if that is an equilibrium [m, rad].
    void add_probe(const std::string &name, const Displacement &form, bool rotational = false);

    /// Sets the displacements of the bodies where probes are zero [m, rad].
    void set_rest_of_probes(const BodyVectors &rest);

    /// Adds an observer, kept by reference. Observers are called in the order of their addition.
    void observe(Observer &observer) { observers.push_back(&observer); }
    void observe(std::unique_ptr<Observer> observer);

    /// Checkpoints are called last and have all observers. begin() continues from the last
    /// checkpoint, if any.
    void observe(Checkpoints &last);

    /// Each rank calls @p asked after each step; a result other than 0 on any rank is the signal()
    /// to end the run.
    void stop_if(std::function<int()> asked) { stop_asked = std::move(asked); }

    /// Calls begin() of the observers and throws their errors.
    void open();

    /// Records the start, or continues from the checkpoint; calls open() if necessary.
    void begin();

    /// Makes and records one accepted step, of length StepperOptions::step or less. Throws the
    /// errors of Stepper::advance() and of the observers.
    void advance();

    /// True after the last step of a scene, or after a request to stop.
    bool is_over() const { return motion.is_finished() || stop_signal != 0; }

    /// Signal to stop; 0: none, or after the last step.
    int signal() const { return motion.is_finished() ? 0 : stop_signal; }

    /// Calls finish() of the observers on this rank only.
    void finish();

    /// Reports of the observers, and the cost of the steps; see Observer::report().
    void report(std::ostream &log, bool failed = false) const;

    /// Quantities of the observers, see Observer::quantities().
    std::vector<NamedQuantity> quantities() const;

    /// Checkpoint data of each observer, complete on the root.
    std::vector<std::string> save() const;

    /// Passes checkpoint data to the observers. Throws UserError if their number differs.
    void resume(const std::vector<std::string> &stored);

    double time() const { return motion.state().time; }

    /// For the steps of this process, without observers [s].
    double stepping_seconds() const { return motion.costs().sums().stepping; }

    const Scene &scene() const { return named; }
    const SceneBodies &structure() const { return bodies; }
    const Constraints &constraints() const { return motion.links(); }
    const Motion &stepped() const { return motion; }
    Motion &stepped() { return motion; }

  private:
    using Clock = std::chrono::steady_clock;

    const Communicator &processes() const { return bodies.communicator(); }
    template <typename Call>
    void each(const Call &call) const;
    void show(const State &state);
    void update_probes(const State &state);
    void update_links(const State &state);
    StepView view(const State &state) const;
    void print_cost(std::ostream &log) const;

    const std::unique_ptr<Scene> own_scene; ///< of a System
    const std::unique_ptr<SceneBodies> own_bodies;
    Motion &motion;
    const Scene &named;
    const SceneBodies &bodies;
    const std::string folder;
    const double interval;
    const std::unique_ptr<Reactions> reactions;
    std::vector<std::vector<Term>> probe_terms;
    std::vector<double> probe_rest, probe_values;
    LinkValues links;
    std::vector<Observer *> observers;
    std::vector<std::unique_ptr<Observer>> owned;
    Checkpoints *checkpoints = nullptr;
    std::function<int()> stop_asked;
    int stop_signal = 0; ///< the same on all ranks; 0: go on
    bool is_open = false;
    double first_time = 0.;        ///< of the state at begin() [s]
    Clock::time_point first, last; ///< times of begin() and finish()
  };
} // namespace taut

#endif
