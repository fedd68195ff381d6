// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/choose_scheme.h>
#include <taut/time/stepper.h>

#include <limits>

namespace taut
{
  Stepper::Stepper(const System &system, const StepperOptions &options)
      : system(system), structure(system.structure()), constraints(system.constraints(structure)),
        start(find_initial_state(structure, constraints, options.solver, options.start)),
        contact_measures(structure, constraints, start.reference, start.state)
  {
    stepper = std::make_unique<TimeStepper>(structure, constraints, options.solver, choose(options),
                                            options.step, start.reference, start.state,
                                            options.start == Start::equilibrium);
    control =
        std::make_unique<StepControl>(options.steps, options.step, std::numeric_limits<long>::max(),
                                      !stepper->is_linear(), longest_steps);
  }

  const TimeIntegrator &Stepper::choose(const StepperOptions &options)
  {
    allow_unsuitable_scheme = options.allow_unsuitable_scheme;
    contact_measures.set_scheme(options.scheme == "automatic", options.steps.adaptive());
    const ContactResolution resolution(structure, constraints, options.solver, options.step,
                                       options.steps.adaptive(), options.end);
    if (options.scheme == "automatic")
    {
      const SchemeChoice choice =
          choose_scheme(structure, constraints, resolution, options.restitution);
      integrator = make_integrator(choice.name, choice.entries);
      scheme_description = integrator->description() + ", because " + choice.reason;
    }
    else
    {
      integrator = make_integrator(options.scheme, options.scheme_entries);
      scheme_description = integrator->description();
      check_mass(*integrator, structure, options.step);
      if (!options.allow_unsuitable_scheme)
        check_scheme(*integrator, structure, constraints, resolution, options.solver,
                     options.steps.longest(options.step));
    }
    if (integrator->coefficients(options.step).velocity_projection)
    {
      constraints.set_conserving(resolution.conserving());
      longest_steps = resolution.longest_steps();
    }
    return *integrator;
  }

  void Stepper::advance()
  {
    do
    {
      control->advance(*stepper);
      if (!allow_unsuitable_scheme)
        stepper->check_moving_contacts();
      contact_measures.record(stepper->state(), stepper->scheme(), stepper->certificate());
    } while (!control->is_at_step());
  }

  const Certificate &Stepper::certificate() const
  {
    return stepper->n_steps_done() == 0 ? start.certificate : stepper->certificate();
  }

  double Stepper::multiplier(const std::size_t constraint) const
  {
    return state().multiplier[constraints.index_of_link(constraint)];
  }

  double Stepper::gap(const std::size_t constraint) const
  {
    return state().geometric_gap[constraints.index_of_link(constraint)];
  }

  double Stepper::displacement(const Displacement &form) const
  {
    double value = evaluate(form, reference().displacement) + evaluate(form, state().U);
    system.communicator().sum(&value, 1);
    return value;
  }

  double Stepper::velocity(const Displacement &form) const
  {
    double value = evaluate(form, state().V);
    system.communicator().sum(&value, 1);
    return value;
  }

  std::vector<double> Stepper::displacement(const std::size_t body) const
  {
    return taut::displacement(reference(), state(), system.index_here(body));
  }
} // namespace taut
