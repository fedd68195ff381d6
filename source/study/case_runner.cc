// SPDX-License-Identifier: LGPL-2.1-or-later

#include "study/case_runner.h"
#include <taut/base/exceptions.h>
#include <taut/simulation/simulation.h>

#include <algorithm>
#include <ctime>
#include <sstream>

namespace taut
{
  std::vector<NamedQuantity> CaseRunner::quantities()
  {
    set_parameters({});
    std::ostringstream silent;
    try
    {
      const Simulation simulation(*parameters, silent, Communicator(), &shared);
      return quantities_of(simulation);
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters->explain(e));
    }
  }

  CaseResult CaseRunner::run(const std::vector<std::string> &entries)
  {
    set_parameters(entries);
    std::ostringstream silent;
    try
    {
      Simulation simulation(*parameters, silent, Communicator(), &shared);
      simulation.stop_if(stop_asked);
      simulation.run();
      return {quantities_of(simulation), simulation.statistics().worst_residuals(),
              simulation.warnings()};
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters->explain(e));
    }
  }

  /// Changes the parameters of the last case, or reads them anew.
  void CaseRunner::set_parameters(const std::vector<std::string> &entries)
  {
    if (parameters && parameters->change(entries))
      return;
    parameters.reset();
    std::vector<std::string> all = overrides;
    all.insert(all.end(), entries.begin(), entries.end());
    auto fresh = std::make_unique<Parameters>();
    for (const auto &[entry, place] : origins)
      fresh->set_origin(entry, place);
    fresh->read(file, all);
    fresh->write_nothing();
    parameters = std::move(fresh);
  }

  namespace
  {
    /// Processor time from the start of a run to its last step [s].
    class Stopwatch : public Observer
    {
    public:
      explicit Stopwatch(const long n_steps) : n_steps(n_steps) {}
      void record(const StepView &) override
      {
        if (n_done == 0)
          begin = std::clock();
        if (n_done++ == n_steps)
          end = std::clock();
      }
      /// At least one tick of the clock.
      double seconds() const
      {
        return static_cast<double>(std::max<std::clock_t>(end - begin, 1)) / CLOCKS_PER_SEC;
      }

    private:
      long n_steps, n_done = 0;
      std::clock_t begin = 0, end = 0;
    };
  } // namespace

  void check_quantities(const Parameters &parameters)
  {
    std::ostringstream silent;
    const Simulation simulation(parameters, silent);
    const QuantityRecorder recorder(parameters.study, simulation);
  }

  MeasuredRun measure_run(const Parameters &parameters, const bool with_quantities,
                          const std::function<int()> &stop_asked)
  {
    std::ostringstream silent;
    try
    {
      if (parameters.step_parameters.adaptive())
        throw EntryError("Time/Step control", "a study compares fixed steps; set 'fixed'");
      Simulation simulation(parameters, silent);
      QuantityRecorder recorder(parameters.study, simulation);
      Stopwatch stopwatch(simulation.n_steps());
      simulation.stop_if(stop_asked);
      simulation.observe(stopwatch);
      if (with_quantities)
        simulation.observe(recorder);
      simulation.run();
      const Residuals &worst = simulation.statistics().worst_residuals();
      return {with_quantities ? recorder.study_quantities() : std::vector<StudyQuantity>(),
              stopwatch.seconds(), std::max(worst.complementarity, worst.balance),
              simulation.n_steps(), simulation.what_steps_miss()};
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters.explain(e));
    }
  }
} // namespace taut
