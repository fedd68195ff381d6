// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/time/stepped_motion.h>

namespace taut
{
  SteppedMotion::SteppedMotion(Structure &structure, Constraints &constraints,
                               const StepperOptions &options)
      : structure(structure), constraints(constraints), options(options),
        initial(find_initial_state(structure, constraints, options.solver, options.start,
                                   options.step)),
        contact_measures(structure, constraints, initial.reference, initial.state)
  {
    contact_measures.set_scheme(options.scheme == "automatic", options.steps.adaptive());
  }

  /// Made on demand only: its factors may be lost in rounding where those of the run are not.
  const ContactResolution &SteppedMotion::resolution()
  {
    if (!resolved)
      resolved =
          std::make_unique<ContactResolution>(structure, constraints, options.solver, options.step,
                                              options.steps.longest(options.step), options.end);
    return *resolved;
  }

  void SteppedMotion::choose_scheme()
  {
    std::map<std::string, std::string> entries = options.scheme_entries;
    chosen.name = options.scheme;
    if (options.scheme == "automatic")
      chosen = taut::choose_scheme(structure, constraints, resolution(), options.restitution);
    for (const auto &[path, value] : chosen.entries)
      entries[path] = value;
    integrator = make_integrator(chosen.name, entries);
  }

  std::string SteppedMotion::scheme() const
  {
    return integrator ? integrator->description() : "";
  }

  std::string SteppedMotion::scheme_and_reason() const
  {
    return scheme() + (chosen.reason.empty() ? "" : ", because " + chosen.reason);
  }

  void SteppedMotion::prepare(const long n_steps)
  {
    const double longest = options.steps.longest(options.step);
    check_mass(*integrator, structure, longest);
    if (options.scheme != "automatic" && !options.allow_unsuitable_scheme)
      check_scheme(
          *integrator, structure, constraints,
          [this]() -> const ContactResolution & { return resolution(); }, options.solver, longest);
    if (integrator->coefficients(longest).velocity_projection)
    {
      constraints.set_conserving(resolution().conserving());
      longest_steps = resolution().longest_steps(constraints);
    }
    resolved.reset();
    stepper = std::make_unique<TimeStepper>(structure, constraints, options.solver, *integrator,
                                            options.step, initial.reference, initial.state,
                                            options.start == Start::equilibrium);
    if (!options.allow_unsuitable_scheme)
      stepper->refuse_rigid_moving_contacts();
    control = std::make_unique<StepControl>(options.steps, options.step, n_steps,
                                            !stepper->is_linear(), longest_steps);
  }

  RunInSteps SteppedMotion::run_in_steps(const long n_steps)
  {
    return {structure,
            constraints,
            options.solver,
            *integrator,
            options.steps,
            options.step,
            n_steps,
            longest_steps,
            initial.reference,
            initial.state,
            options.start == Start::equilibrium};
  }

  void SteppedMotion::advance()
  {
    control->advance(*stepper);
    costs().lap(StepPart::control);
    last = stepper->scheme();
    contact_measures.record(stepper->state(), last, stepper->external_forces());
    costs().lap(StepPart::measures);
  }

  void SteppedMotion::save(OutputArchive &archive)
  {
    stepper->save(archive);
    const StepControl &steps = *control;
    archive << steps;
    contact_measures.save(archive);
  }

  void SteppedMotion::load(InputArchive &archive, State state)
  {
    stepper->load(archive, std::move(state));
    archive >> *control;
    contact_measures.load(archive);
    last = stepper->scheme();
  }
} // namespace taut
