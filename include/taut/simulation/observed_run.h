// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_observed_run_h
#define taut_observed_run_h

#include <taut/output/observer.h>
#include <taut/output/reactions.h>
#include <taut/simulation/checkpoints.h>
#include <taut/time/stepper.h>

#include <chrono>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Steps with observers. Use it in a program of yours that wants tables, fields, statistics or
   * checkpoints of what its Stepper does:
   *
   *     ObservedRun run(stepper, "results");
   *     Statistics statistics({}, run.scene(), run.constraints());
   *     run.observe(statistics);
   *     run.begin();
   *     while (run.time() < 1.)
   *       run.advance();
   *     run.finish();
   *
   * A System is to observers a scene that names nothing but probes: what they know of the items of
   * a scene, as of supports, wires and contacts of surfaces, is empty then. All ranks call each
   * function together, but for finish() after an error.
   */
  class ObservedRun
  {
  public:
    /// @p stepper is kept by reference and steps from now on through this object. The @p folder of
    /// the results is made; @p interval is Output/Interval, for each observer [s].
    ObservedRun(Stepper &stepper, const std::string &folder, double interval = 0.);

    /// The same of a scene, at its start; the references are kept. The folder is not made.
    ObservedRun(SteppedMotion &motion, const Scene &scene, const SceneBodies &structure,
                const std::string &folder, double interval);

    /// Adds a probe, before the observers that have a column of it: the displacement of a form, or
    /// its rotation, from where it was at the start if that is an equilibrium [m, rad].
    void add_probe(const std::string &name, const Displacement &form, bool rotational = false);

    /// Displacements of the bodies that probes count from [m, rad].
    void set_rest_of_probes(const BodyVectors &rest);

    /// Adds an observer, kept by reference. Observers are called in the order of their addition.
    void observe(Observer &observer) { observers.push_back(&observer); }
    void observe(std::unique_ptr<Observer> observer);

    /// Checkpoints have all observers and are called last. If there is one to go on from, begin()
    /// does.
    void observe(Checkpoints &last);

    /// @p asked is called on each rank after each step; what is not 0 on any of them is the
    /// signal() to end the run.
    void stop_if(std::function<int()> asked) { stop_asked = std::move(asked); }

    /// Calls begin() of the observers. Throws what they throw.
    void open();

    /// Records the start, or goes on from the checkpoint; calls open() if nobody did.
    void begin();

    /// One step that counts, of the length StepperOptions::step or less, and its record. Throws
    /// what Stepper::advance() and the observers throw.
    void advance();

    /// True after the last step of a scene, or if the run was asked to stop.
    bool is_over() const { return motion.is_finished() || stop_signal != 0; }

    /// What asked the run to stop; 0: nothing, or after its last step.
    int signal() const { return motion.is_finished() ? 0 : stop_signal; }

    /// Calls finish() of the observers of this rank, and nothing on others.
    void finish();

    /// What the observers say at the end, and what the steps cost; see Observer::report().
    void report(std::ostream &log, bool failed = false) const;

    /// What each observer stores in a checkpoint, complete on the root.
    std::vector<std::string> save() const;

    /// Hands what was stored to as many observers. Throws UserError for another number of them.
    void resume(const std::vector<std::string> &stored);

    double time() const { return motion.state().time; }
    double stepping_seconds() const { return seconds; } ///< of the steps, without observers
    const Scene &scene() const { return named; }
    const SceneBodies &structure() const { return bodies; }
    const Constraints &constraints() const { return motion.links(); }
    const SteppedMotion &stepped() const { return motion; }
    SteppedMotion &stepped() { return motion; }

  private:
    using Clock = std::chrono::steady_clock;

    const Communicator &processes() const { return bodies.communicator(); }
    void each(const std::function<void(Observer &)> &call) const;
    void show(const State &state);
    void update_probes(const State &state);
    StepView view(const State &state) const;
    void print_cost(std::ostream &log) const;

    const std::unique_ptr<Scene> own_scene; ///< of a System
    const std::unique_ptr<SceneBodies> own_bodies;
    SteppedMotion &motion;
    const Scene &named;
    const SceneBodies &bodies;
    const std::string folder;
    const double interval;
    Reactions reactions;
    std::vector<std::vector<Term>> probe_terms;
    std::vector<double> probe_rest, probe_values;
    std::vector<Observer *> observers;
    std::vector<std::unique_ptr<Observer>> owned;
    Checkpoints *checkpoints = nullptr;
    std::function<int()> stop_asked;
    int stop_signal = 0; ///< the same on all ranks; 0: go on
    bool is_open = false;
    double seconds = 0.;
    Clock::time_point first, last; ///< begin() and finish()
  };
} // namespace taut

#endif
