// SPDX-License-Identifier: LGPL-2.1-or-later
#include "counted_run.h"

#include "base/interruption.h"
#include <taut/simulation/simulation.h>

#include <csignal>

namespace allocations
{
  namespace
  {
    /// Counts from one record to the next.
    class Counter : public taut::Observer
    {
    public:
      explicit Counter(const Steps &steps) : steps(steps) { by_step.reserve(steps.counted); }

      void record(const taut::StepView &) override
      {
        const long now = count();
        if (n_records > steps.warm_up && !is_complete())
          by_step.push_back(now - before);
        ++n_records;
        before = count();
      }

      bool is_complete() const { return static_cast<long>(by_step.size()) >= steps.counted; }

      std::vector<long> by_step;

    private:
      const Steps steps;
      long n_records = 0; ///< the first is that of the start
      long before = 0;
    };
  } // namespace

  long CountedRun::total() const
  {
    return std::accumulate(by_step.begin(), by_step.end(), 0L);
  }

  long CountedRun::largest() const
  {
    return by_step.empty() ? 0 : *std::max_element(by_step.begin(), by_step.end());
  }

  long CountedRun::n_without() const
  {
    return std::count(by_step.begin(), by_step.end(), 0L);
  }

  std::vector<std::string> moving_scenes()
  {
    std::vector<std::string> names;
    for (const auto &entry : std::filesystem::directory_iterator(TAUT_PRM_FOLDER))
    {
      if (entry.path().extension() != ".prm")
        continue;
      taut::Parameters parameters;
      parameters.read(entry.path().string(), {});
      if (parameters.end_time > 0.)
        names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  CountedRun run_counted(const std::string &scene, const Steps &steps,
                         const std::vector<std::string> &overrides)
  {
    using verification::operator+;
    verification::Session session(
        verification::scene_file(scene),
        verification::Overrides{"Output/Field interval=0", "Output/Checkpoint interval=0"} +
            overrides);
    return run_counted(session, steps);
  }

  CountedRun run_counted(verification::Session &session, const Steps &steps)
  {
    const long n_steps = session.simulation().n_steps();
    Steps fitting = steps;
    fitting.warm_up = std::min(steps.warm_up, n_steps / 3);
    fitting.counted = std::min(steps.counted, n_steps - fitting.warm_up);

    Counter counter(fitting);
    session.simulation().observe(counter);
    session.simulation().stop_if([&] { return counter.is_complete() ? SIGTERM : 0; });
    CountedRun result;
    try
    {
      session.simulation().run();
    }
    catch (const taut::Interrupted &)
    {
    }
    catch (const std::exception &error)
    {
      result.ending = error.what();
    }
    result.by_step = counter.by_step;
    return result;
  }
} // namespace allocations
