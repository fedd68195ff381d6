// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/time_stepper.h>

namespace taut
{
  namespace
  {
    Constraints &at_time(Constraints &constraints, const double t)
    {
      constraints.update(t);
      return constraints;
    }
  } // namespace

  TimeStepper::TimeStepper(const Structure &structure, Constraints &constraints,
                           const SolverParameters &parameters, const TimeIntegrator &integrator,
                           const double length, Reference reference, State start,
                           const bool at_rest)
      : structure(structure), constraints(at_time(constraints, start.time)), parameters(parameters),
        reference_state(std::move(reference)), current(std::move(start)),
        clock(integrator, length, current.time, at_rest),
        nonlinear(structure, constraints, reference_state),
        step(structure, constraints, this->parameters, reference_state, nonlinear.bodies(),
             nonlinear.constraints(), current),
        loads(structure), errors(structure, constraints, reference_state),
        energy_gains(structure, constraints, nonlinear.bodies(), step.conditions(),
                     nonlinear.constraints())
  {
    nonlinear.follow(current);
    energy_gains.start(current);
    prepare(clock.coefficients(0.));
    if (integrator.coefficients(length).starts_itself())
    {
      structure.communicator().agree([&] { start_balance(); });
      current.gap_rate = constraints.motions(current.V);
    }
  }

  /// Sets r = P + B N - C V - K U at the start, where no scheme needs forces of rigid constraints.
  void TimeStepper::start_balance()
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      std::vector<double> &r = current.balance[k];
      for (std::size_t i = 0; i < r.size(); ++i)
        r[i] = step.history().forces().P[k][i] - current.KU[k][i];
      body.damping().vmult_add(-1., current.V[k].data(), r.data());
    }
    std::vector<double> N = current.multiplier;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (step.conditions().mean_force(i) && !(projection && constraints.slides(i)))
        N[i] = 0.;
    constraints.add_forces(N, current.balance);
    hold_quasi_static_dofs();
  }

  /// Puts quasi-static DoFs in equilibrium at the ends of steps, with a velocity projection.
  void TimeStepper::hold_quasi_static_dofs()
  {
    if (projection)
      for (std::size_t k = 0; k < structure.size(); ++k)
        for (const unsigned int dof : projection->quasi_static_dofs()[k])
          current.balance[k][dof] = 0.;
  }

  /// After an error, no step is prepared.
  void TimeStepper::prepare(const StepCoefficients c)
  {
    coefficients = {};
    nonlinear.prepare(c, clock.step(), current);
    step.prepare(c, clock.step());
    if (c.velocity_projection)
    {
      if (!projection)
        projection = std::make_unique<VelocityProjection>(structure, constraints, parameters,
                                                          reference_state);
      projection->prepare(c, clock.step(), step.conditions().springs().compliance(),
                          step.equations().interface().matrix(), is_linear());
    }
    coefficients = c;
  }

  void TimeStepper::keep_old()
  {
    old.state = current;
    old.certificate = last;
    old.motion = errors.largest_motions;
    step.conditions().gaps().copy_sizes(old.of_gaps);
    constraints.copy_courses(old.courses);
    if (projection)
      old.rates = projection->largest_rates();
    else
      old.rates.clear();
    step.history().keep();
  }

  void TimeStepper::take_back()
  {
    step.history().take_back(current);
    static_cast<SharedState &>(current) = old.state;
    last = old.certificate;
    errors.largest_motions = old.motion;
    step.conditions().gaps().set_sizes(old.of_gaps);
    if (projection && !old.rates.empty())
      projection->set_largest_rates(old.rates);
    clock.take_back();
    constraints.set_courses(old.courses);
    constraints.update(current.time);
    nonlinear.return_to(current);
  }

  void TimeStepper::advance()
  {
    keep_old();
    try
    {
      step_on();
    }
    catch (...)
    {
      const std::exception_ptr error = std::current_exception();
      try
      {
        take_back();
      }
      catch (...)
      {
        // A geometry that fails at the place before, too: the first error says why.
      }
      std::rethrow_exception(error);
    }
  }

  void TimeStepper::step_on()
  {
    last = {};
    const double end = clock.advance(current.last_step);
    if (const StepCoefficients c = clock.coefficients(current.last_step); c != coefficients)
    {
      attempt([&] { prepare(c); });
      costs().lap(StepPart::factors);
    }
    begin_step(end);
    attempt([this] { solve(); });
    if (refuses_rigid)
      check_moving_contacts();
  }

  /// Sets the time at the end of the step, and the places of the constraints there.
  void TimeStepper::begin_step(const double end)
  {
    step.conditions().begin_step(current.last_step == 0.);
    step.history().prescribed().begin_step(current.last_step);
    const double start = current.time;
    current.time = end;
    current.last_step = clock.step();
    step.check().set_time(current.time);
    attempt(
        [&] {
          constraints.follow(reference_state.displacement, current.U, current.V, start,
                             current.time);
        });
    constraints.update(current.time);
    costs().lap(StepPart::places);
    if (nonlinear.constraints().empty())
      step.equations().interface().update_moving();
    costs().lap(StepPart::moving_rows);
  }

  /// Finds the new state and its certificate.
  void TimeStepper::solve()
  {
    if (is_linear())
    {
      step.set_loads(current);
      step.find_increments(current, last);
    }
    else
      nonlinear.find_increments(step, current, last);
    step.accept(current, last);
    step.certify(current, last);
    structure.communicator().agree([&] { nonlinear.bodies().set_own_force(current); });
    face_new_directions();
    costs().lap(StepPart::nonlinear);
    if (coefficients.velocity_projection)
    {
      project_velocities();
      costs().lap(StepPart::projection);
    }
    measure_energy();
    costs().lap(StepPart::energy);
  }

  /// Gives turning constraints the directions of the new state.
  void TimeStepper::face_new_directions()
  {
    if (nonlinear.constraints().empty())
      return;
    nonlinear.follow(current);
    if (coefficients.velocity_projection)
      step.conditions().rates().update(current);
  }

  void TimeStepper::measure_energy()
  {
    if (coefficients.mean_force && !coefficients.velocity_level &&
        (constraints.size() > 0 || !is_linear()))
      energy_gains.measure(step.balance(), current, last);
    else if (!is_linear() && coefficients.is_backward_euler())
      energy_gains.measure_at_ends(current, last);
  }

  /// Sets the final velocities and forces of the step, and the balance for the next step.
  void TimeStepper::project_velocities()
  {
    VelocityProjection::Residual of_rates;
    ContactConditions &conditions = step.conditions();
    step.check().solve(
        [&]
        {
          of_rates = projection->project(conditions, conditions.rates(), current,
                                         step.equations().interface().matrix());
        });
    if (!(of_rates.largest <= last.complementarity))
    {
      last.complementarity = of_rates.largest;
      last.worst_constraint = of_rates.worst;
    }
    step.check().check_constraints(last);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      current.constraint_work[i] += projection->work()[i];
      current.impulse_work += projection->work()[i];
    }
    // Forces of moving constraints act half in their old place.
    for (const std::size_t i : constraints.sliding_rows())
      if (conditions.mean_force(i))
        constraints.add_force(i, current.multiplier[i], current.balance);
    hold_quasi_static_dofs();
  }
} // namespace taut
