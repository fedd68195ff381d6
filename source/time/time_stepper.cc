// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cache_tiles.h"

#include <taut/base/instruction_set.h>
#include <taut/time/time_stepper.h>

#include <algorithm>

namespace taut
{
  namespace
  {
    Constraints &at_time(Constraints &constraints, const double t)
    {
      constraints.update(t);
      return constraints;
    }

    /// Balance from which a step is refined, and how often: ordinary steps are below 1e-11.
    constexpr double refined_balance = 1e-10;
    constexpr int most_refinements = 3;

    /// What is known of velocity and acceleration at the end of a step before its increment is.
    class Predictor
    {
    public:
      Predictor(const StepCoefficients &c, const std::vector<double> &V,
                const std::vector<double> &A, const std::vector<double> &dU,
                const std::vector<double> &V_old)
          : c(c), V(V.data()), A(A.data()), dU(dU.data()), V_old(V_old.data())
      {
      }

      /// Calls visit(i, v*, a*) for DoFs begin to end - 1 and reads only what the scheme needs.
      template <typename Visitor>
      void visit(const std::size_t begin, const std::size_t end, const Visitor &visitor) const
      {
        if (c.looks_back())
#pragma omp simd
          for (std::size_t i = begin; i < end; ++i)
            visitor(i, c.v_V * V[i] + c.v_A * A[i] + c.v_dU * dU[i],
                    c.a_V * V[i] + c.a_A * A[i] + c.a_dU * dU[i] + c.a_V_old * V_old[i]);
        else if (c.v_A != 0. || c.a_A != 0.)
#pragma omp simd
          for (std::size_t i = begin; i < end; ++i)
            visitor(i, c.v_V * V[i] + c.v_A * A[i], c.a_V * V[i] + c.a_A * A[i]);
        else
#pragma omp simd
          for (std::size_t i = begin; i < end; ++i)
            visitor(i, c.v_V * V[i], c.a_V * V[i]);
      }

    private:
      const StepCoefficients c;
      const double *V, *A, *dU, *V_old;
    };
  } // namespace

  TimeStepper::TimeStepper(const Structure &structure, Constraints &constraints,
                           const SolverParameters &parameters, const TimeIntegrator &integrator,
                           const double step, Reference reference, State start, const bool at_rest)
      : structure(structure), constraints(constraints), parameters(parameters),
        integrator(integrator), step(step), reference_state(std::move(reference)),
        current(std::move(start)), first_step_is_backward_euler(!at_rest),
        segment_start(current.time),
        system(std::make_unique<StepEquations>(structure, constraints, this->parameters)),
        turning(at_time(constraints, current.time), reference_state),
        conditions(structure, constraints, turning, reference_state, current),
        nonlinear(structure, reference_state), loads(structure),
        errors(structure, constraints, reference_state),
        energy_gains(structure, constraints, nonlinear, conditions, turning),
        balance(structure, constraints, reference_state, nonlinear),
        check(structure, constraints, this->parameters.contact_tolerance)
  {
    check_turning();
    turning.follow(current);
    for (BodyVectors *v : {&forces.P, &right_hand_side, &lift, &forces.old_A, &forces.old_balance})
      *v = structure.zero();
    forces.external_size.resize(structure.size());
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      set_external_force(k);
      for (std::vector<double> *v : {&work_v, &work_a})
        v->resize(std::max<std::size_t>(v->size(), body.n_dofs()));
      for (std::vector<double> *v : {&damping_of_tile, &inertia_of_tile})
        v->resize(std::max(v->size(), tile_size(body)));
    }
    const StepCoefficients c = integrator.coefficients(step);
    first_step_is_backward_euler = first_step_is_backward_euler && !c.starts_itself();
    bodies_are_linear = !structure.communicator().any(!nonlinear.indices().empty());
    energy_gains.start(current);
    set_nonlinear();
    prepare(first_step_is_backward_euler ? backward_euler(step) : c);
    if (c.starts_itself())
    {
      structure.communicator().agree([&] { start_balance(); });
      current.gap_rate = constraints.motions(current.V);
    }
  }

  /// r = P + B N - C V - K U at the start, where no rigid constraint has a force that a scheme
  /// would need.
  void TimeStepper::start_balance()
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      std::vector<double> &r = current.balance[k];
      for (std::size_t i = 0; i < r.size(); ++i)
        r[i] = forces.P[k][i] - current.KU[k][i];
      body.damping().vmult_add(-1., current.V[k].data(), r.data());
    }
    std::vector<double> N = current.multiplier;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (conditions.mean_force(i) && !(projection && constraints.slides(i)))
        N[i] = 0.;
    constraints.add_forces(N, current.balance);
    hold_quasi_static_dofs();
  }

  /// With a velocity projection they are in equilibrium at the ends of steps.
  void TimeStepper::hold_quasi_static_dofs()
  {
    if (projection)
      for (std::size_t k = 0; k < structure.size(); ++k)
        for (const unsigned int dof : projection->quasi_static_dofs()[k])
          current.balance[k][dof] = 0.;
  }

  /// After an error no step is prepared for.
  void TimeStepper::prepare(const StepCoefficients c)
  {
    coefficients = {};
    turning.prepare(c);
    tangents_are_kept = false;
    nonlinear.begin(current, c, step);
    conditions.prepare(c, step);
    system->prepare(c, conditions.springs().compliance());
    if (c.velocity_projection)
    {
      if (!projection)
        projection = std::make_unique<VelocityProjection>(structure, constraints, parameters,
                                                          reference_state);
      projection->prepare(c, step, conditions.springs().compliance(), system->interface().matrix());
    }
    coefficients = c;
  }

  void TimeStepper::advance()
  {
    ++n_steps;
    last = {};
    before_step = {errors.largest_motions, conditions.gaps().sizes(), constraints.courses(),
                   projection ? projection->largest_rates() : std::vector<double>()};
    const bool is_first = current.last_step == 0.;
    const StepCoefficients c = is_first && first_step_is_backward_euler ? backward_euler(step)
                               : is_first || current.last_step == step
                                   ? integrator.coefficients(step)
                                   : integrator.after_change(step, current.last_step);
    if (c != coefficients)
      attempt([&] { prepare(c); });
    const double start = current.time;
    current.time = segment_start + ++n_in_segment * step;
    check.set_time(current.time);
    conditions.begin_step(is_first);
    step_before = current.last_step;
    current.last_step = step;
    attempt(
        [&] {
          constraints.follow(reference_state.displacement, current.U, current.V, start,
                             current.time);
        });
    constraints.update(current.time);
    if (turning.empty())
      system->interface().update_moving();

    attempt([this] { solve(); });
  }

  /// The new state and its certificate.
  void TimeStepper::solve()
  {
    const StepCoefficients &c = coefficients;
    if (is_linear())
    {
      set_loads();
      find_increments();
    }
    else
      iterate();
    accept_increments();
    conditions.update(current);
    certify();
    structure.communicator().agree([&] { nonlinear.set_own_force(current); });
    if (!turning.empty())
    {
      turning.follow(current);
      if (c.velocity_projection)
        conditions.rates().update(current);
    }
    if (c.velocity_projection)
      project_velocities();
    if (c.mean_force && !c.velocity_level && (constraints.size() > 0 || !is_linear()))
      energy_gains.measure(balance, current, last);
    else if (!is_linear() && c.is_backward_euler())
      energy_gains.measure_at_ends(current, last);
  }

  /// P - P_ref at the time of the state.
  void TimeStepper::set_external_force(const std::size_t k)
  {
    const Substructure &body = structure[k];
    std::vector<double> &P = forces.P[k];
    body.external_force(current.time, P);
    const double *f = reference_state.force[k].data();
    for (std::size_t i = 0; i < P.size(); ++i)
      P[i] -= f[i];
    forces.external_size[k] = largest(body, P);
  }

  /// P^_k = P - K U + kappa r - C v* - M a*, with the balance r of the step before, v* the part of
  /// the velocity that is known and a* that of the mean acceleration, see StepCoefficients.
  void TimeStepper::set_history(const std::size_t k)
  {
    const Substructure &body = structure[k];
    const StepCoefficients &c = coefficients;
    if (body.external_force_varies())
      set_external_force(k);
    system->bodies().remove_rounding(k, current.KU[k], current.balance[k]);

    const Predictor known(c, current.V[k], current.A[k], current.dU[k], current.V_old[k]);
    const bool old_forces_count = c.alpha_m != 0. || c.alpha_f != 0.,
               velocity_is_known = c.v_V != 0. || c.v_A != 0. || c.v_dU != 0.;
    const double kappa = c.old_balance(), old = c.old_inertia(), now = c.new_inertia();
    const double *A = current.A[k].data(), *p = forces.P[k].data(), *KU = current.KU[k].data(),
                 *r = current.balance[k].data();
    double *v = work_v.data(), *a = work_a.data(), *Cv = damping_of_tile.data(),
           *Ma = inertia_of_tile.data(), *R = right_hand_side[k].data();
    std::size_t done = 0;
    visit_tiles(body,
                [&](const std::size_t begin, const std::size_t end, const std::size_t reached)
                {
                  vectorised(
                      [=]
                      {
                        known.visit(
                            done, reached,
                            [=](const std::size_t i, const double known_v, const double known_a)
                            {
                              v[i] = known_v;
                              a[i] = old_forces_count ? now * known_a + old * A[i] : known_a;
                            });
                      });
                  done = reached;
                  if (velocity_is_known)
                    body.damping().vmult_rows(begin, end, v, Cv);
                  body.mass().vmult_rows(begin, end, a, Ma);
                  vectorised(
                      [=]
                      {
#pragma omp simd
                        for (std::size_t i = begin; i < end; ++i)
                        {
                          double sum = p[i] - KU[i];
                          if (old_forces_count)
                            sum += kappa * r[i];
                          if (velocity_is_known)
                            sum -= Cv[i - begin];
                          R[i] = sum - Ma[i - begin];
                        }
                      });
                });

    if (body.has_moving_constraints())
    {
      std::vector<double> &L = lift[k];
      for (const ConstrainedDof &constraint : body.constraints())
        L[constraint.dof] =
            constraint.at(current.time) -
            (reference_state.displacement[k][constraint.dof] + current.U[k][constraint.dof]);
      system->lift(k, L, right_hand_side[k]);
    }
  }

  /// Velocities and forces that the step ends with, and the balance that the next one looks back
  /// at.
  void TimeStepper::project_velocities()
  {
    check.solve(
        [&] {
          projection->project(conditions, conditions.rates(), current,
                              system->interface().matrix());
        });
    if (!(projection->residual() <= last.complementarity))
    {
      last.complementarity = projection->residual();
      last.worst_constraint = projection->worst_constraint();
    }
    check.check_constraints(last);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      current.constraint_work[i] += projection->work()[i];
      current.impulse_work += projection->work()[i];
    }
    // Forces of moving constraints act half in their old place.
    std::vector<double> &moving = work_rows;
    moving = current.multiplier;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (!constraints.slides(i) || !conditions.mean_force(i))
        moving[i] = 0.;
    constraints.add_forces(moving, current.balance);
    hold_quasi_static_dofs();
  }

  /// New displacements, velocities and accelerations, and the balance with them.
  void TimeStepper::accept_increments()
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      current.dU[k].swap(right_hand_side[k]);
      current.V_old[k].swap(current.V[k]);
      forces.old_A[k].swap(current.A[k]);
      forces.old_balance[k].swap(current.balance[k]);
      if (structure[k].has_moving_constraints())
        for (const ConstrainedDof &constraint : structure[k].constraints())
          current.dU[k][constraint.dof] = lift[k][constraint.dof];
    }
    measure_balance([this](const std::size_t k, const std::size_t begin, const std::size_t end)
                    { accept(k, begin, end); });
  }

  /// Rows of the state, from its increment. Where V and the right-hand side will be is what the
  /// scheme looks back at.
  void TimeStepper::accept(const std::size_t k, const std::size_t begin, const std::size_t end)
  {
    const double velocity = coefficients.velocity, acceleration = coefficients.acceleration;
    const double *dU = current.dU[k].data();
    double *U = current.U[k].data(), *V = current.V[k].data(), *A = current.A[k].data();
    const auto visitor = [=](const std::size_t i, const double known_v, const double known_a)
    {
      U[i] += dU[i];
      V[i] = velocity * dU[i] + known_v;
      A[i] = acceleration * dU[i] + known_a;
    };
    const Predictor known(coefficients, current.V_old[k], forces.old_A[k], right_hand_side[k],
                          current.V[k]);
    vectorised([=] { known.visit(begin, end, visitor); });
  }

  void TimeStepper::measure_balance(const BalanceCertificate::SetRows &set_rows)
  {
    structure.communicator().agree(
        [&]
        {
          own_balance = balance.measure(coefficients, forces, conditions.in_balance(),
                                        conditions.impulsive(), current, set_rows);
        });
    last.balance = structure.communicator().max(own_balance);
  }

  void TimeStepper::certify()
  {
    for (int refinements = 0; last.balance > refined_balance && refinements < most_refinements &&
                              !coefficients.mean_force && is_cancellation() && refine();
         ++refinements)
      measure_balance();
    last.worst_body = balance.worst_body();
    certify_rows();
    check.check_balance(last, own_balance);
  }

  /// On all ranks.
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
