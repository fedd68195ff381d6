// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/instruction_set.h>
#include <taut/time/time_stepper.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>

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
    class KnownMotion
    {
    public:
      KnownMotion(const StepCoefficients &c, const State &state, const std::size_t k)
          : c(c), V(state.V[k].data()), A(state.A[k].data()), dU(state.dU[k].data()),
            V_old(state.V_old[k].data())
      {
      }

      /// Calls visit(i, v*, a*) for DoFs 0 to n - 1 and reads only what the scheme needs.
      template <typename Visitor>
      void visit(const std::size_t n, const Visitor &visitor) const
      {
        if (c.looks_back())
#pragma omp simd
          for (std::size_t i = 0; i < n; ++i)
            visitor(i, c.v_V * V[i] + c.v_A * A[i] + c.v_dU * dU[i],
                    c.a_V * V[i] + c.a_A * A[i] + c.a_dU * dU[i] + c.a_V_old * V_old[i]);
        else if (c.v_A != 0. || c.a_A != 0.)
#pragma omp simd
          for (std::size_t i = 0; i < n; ++i)
            visitor(i, c.v_V * V[i] + c.v_A * A[i], c.a_V * V[i] + c.a_A * A[i]);
        else
#pragma omp simd
          for (std::size_t i = 0; i < n; ++i)
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
        system(std::make_unique<StepSystem>(structure, constraints, this->parameters)),
        constraint_motions(structure, at_time(constraints, current.time), reference_state, current),
        balance(structure, constraints, reference_state),
        check(structure, constraints, this->parameters.contact_tolerance)
  {
    for (BodyVectors *v : {&forces.P, &right_hand_side, &lift, &forces.old_A, &forces.old_balance})
      *v = structure.zero();
    forces.external_size.resize(structure.size());
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      set_external_force(k);
      for (std::vector<double> *v : {&work_v, &work_a})
        v->resize(std::max<std::size_t>(v->size(), body.n_dofs()));
    }
    const StepCoefficients c = integrator.coefficients(step);
    first_step_is_backward_euler = first_step_is_backward_euler && !c.starts_itself();
    double moving_supports = 0.;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      moving_supports += structure[k].has_moving_constraints();
      std::fill(work_a.begin(), work_a.end(), 0.);
      structure[k].mass().vmult_add(.5, current.V[k].data(), work_a.data());
      current.kinetic_energy +=
          std::inner_product(current.V[k].begin(), current.V[k].end(), work_a.begin(), 0.);
    }
    double sums[] = {moving_supports, current.kinetic_energy};
    structure.communicator().sum(sums, 2);
    supports_move = sums[0] > 0.;
    current.kinetic_energy = sums[1];
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
      if (constraint_motions.mean_force(i) && !(projection && constraints[i].moving))
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

  void TimeStepper::prepare(const StepCoefficients &c)
  {
    coefficients = c;
    constraint_motions.prepare(c, step);
    system->prepare(c, constraint_motions.compliance());
    if (!c.velocity_projection)
      return;
    if (!projection)
      projection = std::make_unique<VelocityProjection>(structure, constraints, parameters);
    projection->prepare(c, step, constraint_motions.compliance(), system->interface().matrix());
  }

  void TimeStepper::advance()
  {
    ++n_steps;
    const bool is_first = current.last_step == 0.;
    const StepCoefficients c = is_first && first_step_is_backward_euler ? backward_euler(step)
                               : is_first || current.last_step == step
                                   ? integrator.coefficients(step)
                                   : integrator.after_change(step, current.last_step);
    if (c != coefficients)
      prepare(c);
    current.time = segment_start + ++n_in_segment * step;
    check.set_time(current.time);
    step_before = current.last_step;
    current.last_step = step;
    constraints.update(current.time);
    system->interface().update_moving();

    structure.communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < structure.size(); ++k)
            set_history(k);
        });
    if (const std::vector<double> &old = constraint_motions.old_place(current); !old.empty())
      constraints.add_forces(old, right_hand_side);
    constraint_motions.set_problem(current, *system, right_hand_side, lift);
    if (constraints.size() > 0 || system->has_modes())
      constraint_motions.set_multipliers(
          system->find_multipliers(constraint_motions.problem(), check, last), current);
    system->find_increments(constraint_motions.applied().multiplier,
                            constraint_motions.applied().mode_amplitude, right_hand_side);
    for (std::size_t k = 0; k < structure.size(); ++k)
      accept(k);
    constraint_motions.update(current);
    certify();
    if (c.velocity_projection)
      project_velocities();
    if (c.mean_force && !c.velocity_level && constraints.size() > 0)
      measure_energy();
  }

  /**
   * The change of kinetic energy, minus the work of all forces but those of fixed constraints with
   * a mean force, plus what the springs of these take: not positive but for rounding. Where
   * supports move it would be the work of their forces, too, and is not measured.
   */
  void TimeStepper::measure_energy()
  {
    double sums[] = {0., -balance.work()};
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::vector<double> &V = current.V[k], &product = work_a;
      std::fill(product.begin(), product.end(), 0.);
      structure[k].mass().vmult_add(.5, V.data(), product.data());
      sums[0] += std::inner_product(V.begin(), V.end(), product.begin(), 0.);
    }
    structure.communicator().sum(sums, 2);
    double gain = sums[0] - current.kinetic_energy + sums[1];
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (!constraint_motions.mean_force(i))
        continue;
      if (constraints[i].moving)
        gain -= current.constraint_work[i];
      if (!constraints[i].moving && !std::isinf(constraints[i].stiffness))
      {
        const State::LinkSpring &spring = current.link_springs[i];
        const double before = spring.u - spring.du;
        gain += .5 * constraints[i].stiffness * (spring.u * spring.u - before * before);
      }
    }
    last.kinetic_energy = current.kinetic_energy = sums[0];
    last.energy_gain = supports_move ? 0. : gain;
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

  /// P^_k = P - K U - C v* - M a*, with v* and a* the parts of velocity and acceleration that are
  /// known.
  void TimeStepper::set_history(const std::size_t k)
  {
    const Substructure &body = structure[k];
    const StepCoefficients &c = coefficients;
    if (body.external_force_varies())
      set_external_force(k);
    system->bodies().remove_rounding(k, current.KU[k], current.balance[k]);

    const double kappa = c.old_balance();
    const double old = c.old_inertia(), now = c.new_inertia();
    const double *A = current.A[k].data(), *p = forces.P[k].data(), *KU = current.KU[k].data(),
                 *r = current.balance[k].data();
    double *v = work_v.data(), *m = work_a.data(), *R = right_hand_side[k].data();
    const KnownMotion known(c, current, k);
    const bool velocity_is_known = c.v_V != 0. || c.v_A != 0. || c.v_dU != 0.;
    const auto set = [&](const auto with_old_forces, const auto with_velocity)
    {
      const auto visitor = [=](const std::size_t i, const double known_v, const double known_a)
      {
        if (with_velocity)
          v[i] = known_v;
        m[i] = with_old_forces ? now * known_a + old * A[i] : known_a;
        R[i] = p[i] - KU[i] + (with_old_forces ? kappa * r[i] : 0.);
      };
      vectorised([=, n = body.n_dofs()] { known.visit(n, visitor); });
    };
    if (c.alpha_m != 0. || c.alpha_f != 0.)
      set(std::true_type(), std::true_type());
    else if (velocity_is_known)
      set(std::false_type(), std::true_type());
    else
      set(std::false_type(), std::false_type());
    if (velocity_is_known)
      body.damping().vmult_add(-1., v, R);
    body.mass().vmult_add(-1., m, R);

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
    check.solve([&] { projection->project(constraint_motions, current); });
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
      if (!constraints[i].moving || !constraint_motions.mean_force(i))
        moving[i] = 0.;
    constraints.add_forces(moving, current.balance);
    hold_quasi_static_dofs();
  }

  /// New displacement, velocity and acceleration of a body, from its increment.
  void TimeStepper::accept(const std::size_t k)
  {
    const double velocity = coefficients.velocity, acceleration = coefficients.acceleration;
    std::vector<double> &increment = right_hand_side[k];
    if (structure[k].has_moving_constraints())
      for (const ConstrainedDof &constraint : structure[k].constraints())
        increment[constraint.dof] = lift[k][constraint.dof];

    const double *dU = increment.data();
    double *U = current.U[k].data(), *V = current.V_old[k].data(), *A = forces.old_A[k].data();
    const auto visitor = [=](const std::size_t i, const double known_v, const double known_a)
    {
      U[i] += dU[i];
      V[i] = velocity * dU[i] + known_v;
      A[i] = acceleration * dU[i] + known_a;
    };
    vectorised([known = KnownMotion(coefficients, current, k), visitor, n = increment.size()]
               { known.visit(n, visitor); });
    current.dU[k].swap(increment);
    current.V_old[k].swap(current.V[k]);
    forces.old_A[k].swap(current.A[k]);
    forces.old_balance[k].swap(current.balance[k]);
  }

  void TimeStepper::certify()
  {
    const Communicator &processes = structure.communicator();
    double own_balance = 0.;
    for (int refinements = 0;; ++refinements)
    {
      processes.agree(
          [&]
          {
            own_balance = balance.measure(coefficients, forces, constraint_motions.in_balance(),
                                          constraint_motions.impulsive(), current);
          });
      last.balance = processes.max(own_balance);
      if (!(last.balance > refined_balance) || refinements == most_refinements ||
          coefficients.mean_force || processes.max(balance.is_cancellation() ? 0. : 1.) > 0. ||
          !refine())
        break;
    }
    last.worst_body = balance.worst_body();
    certify_rows();
    check.check_balance(last, own_balance);
  }

  void TimeStepper::certify_rows()
  {
    last.complementarity =
        constraint_motions.residual(current, system->interface().matrix(), last.worst_constraint);
    last.drift = constraint_motions.drift(current);
    check.check_constraints(last);
  }
} // namespace taut
