// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/simulation/simulation.h>
#include <taut/time/step_accuracy.h>

#include <ostream>

namespace taut
{
  void Simulation::prepare_step_check(const TimeIntegrator &integrator)
  {
    if (parameters.check_steps == "no" || n_steps() == 0)
      return;
    RunInSteps run = {bodies,
                      links,
                      parameters.solver,
                      integrator,
                      parameters.step_parameters,
                      parameters.step,
                      n_steps(),
                      longest_steps,
                      reference,
                      start,
                      model.start == Start::equilibrium};
    if (parameters.check_steps == "yes" ||
        (parameters.scheme == "automatic" && StepAccuracy::is_affordable(run)))
      accuracy = std::make_unique<StepAccuracy>(std::move(run));
  }

  void Simulation::check_steps()
  {
    if (!accuracy || stop_signal != 0)
      return;
    accuracy->measure(
        [&]
        {
          const int asked = stop_asked ? stop_asked() : 0;
          stop_signal = static_cast<int>(processes.max(asked));
          return stop_signal != 0;
        });
    stop_signal = 0; // it came too late to matter
  }

  void Simulation::print_cost(const TimeStepper &stepper, const double until,
                              const double all) const
  {
    const long n_steps = stepper.n_steps_done();
    if (n_steps == 0)
      return;
    log << n_steps << " steps in " << all << " s, " << until / all
        << " x real time; without output " << 1e6 * seconds / n_steps << " us a step, "
        << until / seconds << " x real time\n";
    if (!stepper.is_linear())
      log << "Newton's method: " << static_cast<double>(stepper.n_newton_iterations()) / n_steps
          << " solves a step\n";
    const InterfaceStatistics solves = stepper.interface_statistics();
    if (solves.n_systems > 0)
      log << "Conjugate gradients: " << static_cast<double>(solves.n_iterations) / solves.n_systems
          << " iterations a system, " << static_cast<double>(solves.n_systems) / n_steps
          << " systems a step, "
          << static_cast<double>(solves.n_local_solves) / solves.n_applications
          << " bodies solved a product\n";
  }

  RunDescription Simulation::description(const bool is_partial) const
  {
    std::vector<Warning> warnings = limits->warnings();
    const auto append = [&](const std::vector<Warning> &more)
    { warnings.insert(warnings.end(), more.begin(), more.end()); };
    append(measures->warnings());
    if (accuracy)
      append(accuracy->warnings());
    return {parameters.file_name(),
            parameters.generator_name,
            scheme,
            parameters.step,
            n_steps() * parameters.step,
            is_partial,
            warnings};
  }
} // namespace taut
