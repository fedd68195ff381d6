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

    /// Balance above which a step is refined, and most repetitions: normal steps are below 1e-11.
    constexpr double refined_balance = 1e-10;
    constexpr int most_refinements = 3;
  } // namespace

  TimeStepper::TimeStepper(const Structure &structure, Constraints &constraints,
                           const SolverParameters &parameters, const TimeIntegrator &integrator,
                           const double step, Reference reference, State start, const bool at_rest)
      : structure(structure), constraints(at_time(constraints, start.time)), parameters(parameters),
        reference_state(std::move(reference)), current(std::move(start)),
        clock(integrator, step, current.time, at_rest),
        system(std::make_unique<StepEquations>(structure, constraints, this->parameters)),
        newton(structure, constraints, reference_state),
        conditions(structure, constraints, newton.constraints(), reference_state, current),
        history(structure, reference_state), loads(structure),
        errors(structure, constraints, reference_state),
        energy_gains(structure, constraints, newton.bodies(), conditions, newton.constraints()),
        balance(structure, constraints, reference_state, newton.bodies()),
        check(structure, constraints, this->parameters.contact_tolerance)
  {
    newton.follow(current);
    history.set_external_forces(current.time);
    energy_gains.start(current);
    newton.attach(*system);
    prepare(clock.coefficients(0.));
    if (integrator.coefficients(step).starts_itself())
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
        r[i] = history.forces().P[k][i] - current.KU[k][i];
      body.damping().vmult_add(-1., current.V[k].data(), r.data());
    }
    std::vector<double> N = current.multiplier;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (conditions.mean_force(i) && !(projection && constraints.slides(i)))
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
    newton.prepare(c, clock.step(), current);
    conditions.prepare(c, clock.step());
    system->prepare(c, conditions.springs().compliance());
    if (c.velocity_projection)
    {
      if (!projection)
        projection = std::make_unique<VelocityProjection>(structure, constraints, parameters,
                                                          reference_state);
      projection->prepare(c, clock.step(), conditions.springs().compliance(),
                          system->interface().matrix());
    }
    coefficients = c;
  }

  void TimeStepper::advance()
  {
    last = {};
    before_step = {errors.largest_motions, conditions.gaps().sizes(), constraints.courses(),
                   projection ? projection->largest_rates() : std::vector<double>()};
    const double end = clock.advance(current.last_step);
    if (const StepCoefficients c = clock.coefficients(current.last_step); c != coefficients)
      attempt([&] { prepare(c); });
    begin_step(end);
    attempt([this] { solve(); });
  }

  /// Sets the time at the end of the step, and the places of the constraints there.
  void TimeStepper::begin_step(const double end)
  {
    conditions.begin_step(current.last_step == 0.);
    const double start = current.time;
    current.time = end;
    current.last_step = clock.step();
    check.set_time(current.time);
    attempt(
        [&] {
          constraints.follow(reference_state.displacement, current.U, current.V, start,
                             current.time);
        });
    constraints.update(current.time);
    if (newton.constraints().empty())
      system->interface().update_moving();
  }

  /// Finds the new state and its certificate.
  void TimeStepper::solve()
  {
    if (is_linear())
    {
      set_loads();
      find_increments();
    }
    else
      newton.find_increments({current, *system, history, conditions, [this] { set_loads(); },
                              [this] { find_increments(); }});
    accept_increments();
    certify();
    structure.communicator().agree([&] { newton.bodies().set_own_force(current); });
    face_new_directions();
    if (coefficients.velocity_projection)
      project_velocities();
    measure_energy();
  }

  void TimeStepper::set_loads()
  {
    structure.communicator().agree([&] { history.set_loads(coefficients, *system, current); });
    if (const std::vector<double> &old = conditions.forces_at_previous_place(current); !old.empty())
      constraints.add_forces(old, history.loads());
  }

  /// Finds N of the step, and dU from P^.
  void TimeStepper::find_increments()
  {
    conditions.set_problem(current, *system, history.loads(), history.lift());
    if (constraints.size() > 0 || system->has_modes())
    {
      const Certificate before = last;
      conditions.find_multipliers(*system, check, last, current);
      last.iterations += before.iterations;
      last.fallback = last.fallback || before.fallback;
    }
    system->find_increments(conditions.applied().multiplier, conditions.applied().mode_amplitude,
                            history.increments());
  }

  /// Sets new displacements, velocities, accelerations, balance and gaps.
  void TimeStepper::accept_increments()
  {
    history.exchange(current);
    measure_balance([this](const std::size_t k, const std::size_t begin, const std::size_t end)
                    { history.accept(coefficients, k, begin, end, current); });
    conditions.update(current);
  }

  /// Gives turning constraints the directions of the new state.
  void TimeStepper::face_new_directions()
  {
    if (newton.constraints().empty())
      return;
    newton.follow(current);
    if (coefficients.velocity_projection)
      conditions.rates().update(current);
  }

  void TimeStepper::measure_energy()
  {
    if (coefficients.mean_force && !coefficients.velocity_level &&
        (constraints.size() > 0 || !is_linear()))
      energy_gains.measure(balance, current, last);
    else if (!is_linear() && coefficients.is_backward_euler())
      energy_gains.measure_at_ends(current, last);
  }

  /// Sets the final velocities and forces of the step, and the balance for the next step.
  void TimeStepper::project_velocities()
  {
    VelocityProjection::Residual of_rates;
    check.solve(
        [&]
        {
          of_rates = projection->project(conditions, conditions.rates(), current,
                                         system->interface().matrix());
        });
    if (!(of_rates.largest <= last.complementarity))
    {
      last.complementarity = of_rates.largest;
      last.worst_constraint = of_rates.worst;
    }
    check.check_constraints(last);
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

  void TimeStepper::measure_balance(const BalanceCertificate::SetRows &set_rows)
  {
    structure.communicator().agree(
        [&]
        {
          balance.measure(coefficients, history.forces(), conditions.in_balance(),
                          conditions.impulsive(), current, set_rows);
        });
    last.balance = structure.communicator().max(balance.residual());
  }

  void TimeStepper::certify()
  {
    for (int refinements = 0; last.balance > refined_balance && refinements < most_refinements &&
                              !coefficients.mean_force && is_cancellation() && refine();
         ++refinements)
      measure_balance();
    last.worst_body = balance.worst_body();
    certify_rows();
    check.check_balance(last, balance.residual());
  }

  /// True if this holds on all ranks.
  bool TimeStepper::is_cancellation() const
  {
    return !structure.communicator().any(!balance.is_cancellation());
  }

  void TimeStepper::certify_rows()
  {
    last.complementarity =
        conditions.residual(current, system->interface().matrix(), last.worst_constraint);
    last.drift = conditions.drift(current);
    check.check_constraints(last);
  }
} // namespace taut
