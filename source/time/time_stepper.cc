// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/time/time_stepper.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace taut
{
  TimeStepper::TimeStepper(const Structure &structure, ContactRows &rows,
                           const SolverParameters &parameters, const TimeIntegrator &integrator,
                           const double step, Reference reference, State start, const bool at_rest)
      : structure(structure), rows(rows), parameters(parameters), integrator(integrator),
        step(step), origin(std::move(reference)), current(std::move(start)),
        first_step_by_source(!at_rest), start_time(current.time),
        solvers(structure, parameters.local_solver),
        schur(make_schur_complement(parameters.interface, solvers, rows)),
        complementarity(parameters.complementarity)
  {
    for (BlockVector *v : {&P, &right_hand_side, &lift, &predictor_v, &predictor_a, &old_A,
                           &old_balance, &increment})
      *v = structure.zero();
    const std::size_t n = rows.size();
    for (auto *v : {&link_history, &gap_terms, &gap_correction, &motion, &position, &terms_size,
                    &motion_size})
      v->assign(n, 0.);
    problem.unilateral.resize(n);
    problem.free_gap.resize(n);
    problem.gap_scale.resize(n);
    rows.update(current.time);
    reference_gap = rows.motions(origin.displacement);
    const std::vector<double> motions = rows.motions(current.U);
    for (std::size_t i = 0; i < n; ++i)
    {
      problem.unilateral[i] = rows[i].unilateral;
      reference_gap[i] += rows[i].gap;
      if (rows[i].moving)
        gap_correction[i] = current.geometric_gap[i] - reference_gap[i] - motions[i];
      // A displacement rounds with the largest of its body.
      for (const auto &[k, form] : rows[i].terms)
      {
        const PerKind size = largest(structure[k], origin.displacement[k]);
        for (std::size_t j = 0; j < form.index.size(); ++j)
          gap_terms[i] += std::fabs(form.value[j]) * size[structure[k].kind(form.index[j])];
      }
    }
    structure.communicator().sum(gap_terms);
    for (std::size_t i = 0; i < n; ++i)
      gap_terms[i] += std::fabs(rows[i].gap);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      reference_force.push_back(largest(body, origin.force[k]));
      norms.push_back({KindNorm(body, body.mass()), KindNorm(body, body.damping()),
                       KindNorm(body, body.stiffness())});
    }
    prepare(first_step_by_source ? backward_euler(step) : integrator.coefficients(step));
  }

  void TimeStepper::prepare(const StepCoefficients &c)
  {
    coefficients = c;
    structure.communicator().agree([&] { solvers.factor(c.mass_factor(), c.velocity); });
    compliance.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      compliance[i] = 1. / (rows[i].stiffness + c.velocity * rows[i].damping);
    schur->setup(compliance);
  }

  void TimeStepper::advance()
  {
    ++n_steps;
    current.time = start_time + n_steps * step;
    if (first_step_by_source && n_steps == 2)
      prepare(integrator.coefficients(step));
    rows.update(current.time);
    schur->update_moving();

    structure.communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < structure.size(); ++k)
            set_history(k);
        });
    set_free_gaps();
    solve_rows();
    rows.add_forces(current.multiplier, right_hand_side);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      solvers[k].solve(right_hand_side[k]);
      increment[k].swap(right_hand_side[k]);
      accept(k);
    }
    share_motions();
    update_rows();
    certify();
  }

  /// P^_k = P - K U - C v* - M a*, with v* and a* the parts of velocity and acceleration that are
  /// known.
  void TimeStepper::set_history(const std::size_t k)
  {
    const Substructure &body = structure[k];
    const StepCoefficients &c = coefficients;
    body.external_force(current.time, P[k]);

    const std::size_t n = body.n_dofs();
    const double kappa = c.alpha_f / (1. - c.alpha_f);
    const double old = c.alpha_m / (1. - c.alpha_f), now = (1. - c.alpha_m) / (1. - c.alpha_f);
    const double *V = current.V[k].data(), *A = current.A[k].data(), *dU = current.dU[k].data(),
                 *V_old = current.V_old[k].data(), *f = origin.force[k].data(),
                 *KU = current.KU[k].data(), *r = current.balance[k].data();
    double *p = P[k].data(), *v = predictor_v[k].data(), *a = predictor_a[k].data(),
           *R = right_hand_side[k].data();
    work.resize(n);
    double *m = work.data();
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i)
    {
      p[i] -= f[i];
      v[i] = c.v_V * V[i] + c.v_A * A[i] + c.v_dU * dU[i];
      a[i] = c.a_V * V[i] + c.a_A * A[i] + c.a_dU * dU[i] + c.a_V_old * V_old[i];
      m[i] = now * a[i] + old * A[i];
      R[i] = p[i] - KU[i] + kappa * r[i];
    }
    if (c.v_V != 0. || c.v_A != 0. || c.v_dU != 0.)
      body.damping().vmult_add(-1., v, R);
    body.mass().vmult_add(-1., m, R);

    if (body.has_moving_constraints())
    {
      std::vector<double> &L = lift[k];
      for (const ConstrainedDof &constraint : body.constraints())
        L[constraint.dof] = constraint.motion(0., current.time) -
                            (origin.displacement[k][constraint.dof] + current.U[k][constraint.dof]);
      body.mass().vmult_add(-c.mass_factor(), L.data(), R);
      body.damping().vmult_add(-c.velocity, L.data(), R);
      body.stiffness().vmult_add(-1., L.data(), R);
    }
  }

  /// The gaps that the step would have without contact forces.
  void TimeStepper::set_free_gaps()
  {
    const StepCoefficients &c = coefficients;
    share_free_motion();
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const Row &row = rows[i];
      // Kelvin-Voigt: N = k u + c u' with u' = velocity du + known.
      const State::LinkSpring &spring = current.link_springs[i];
      link_history[i] = 0.;
      if (row.damping > 0.)
      {
        const double known = c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du;
        link_history[i] = compliance[i] * row.damping * (c.velocity * spring.u - known);
      }

      double before = current.geometric_gap[i], scale = std::fabs(before);
      if (row.moving)
      {
        before = moving_gap(i);
        scale = std::fabs(row.gap) + terms_size[i];
      }
      scale += motion_size[i];
      problem.free_gap[i] = before + motion[i] + link_history[i];
      problem.gap_scale[i] = scale + std::fabs(motion[i]) + std::fabs(link_history[i]);
    }
  }

  double TimeStepper::moving_gap(const std::size_t i) const
  {
    return rows[i].gap + gap_correction[i] + position[i];
  }

  /// Before the contact forces are known: how the rows would move without them, where the moving
  /// ones are, and what these numbers round with.
  void TimeStepper::share_free_motion()
  {
    schur->free_motion(right_hand_side, motion, motion_size);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const std::vector<Term> &terms = rows[i].terms;
      motion[i] += evaluate(terms, lift);
      // The ends of a row move together most of the time: each of them rounds for itself.
      motion_size[i] += step * magnitude(terms, current.V);
      position[i] = terms_size[i] = 0.;
      if (rows[i].moving)
      {
        position[i] = evaluate(terms, origin.displacement) + evaluate(terms, current.U);
        terms_size[i] = magnitude(terms, origin.displacement) + magnitude(terms, current.U);
      }
    }
    share({&motion, &motion_size, &position, &terms_size});
  }

  /// After the step: increment of the rows, and their motion since the reference.
  void TimeStepper::share_motions()
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const std::vector<Term> &terms = rows[i].terms;
      motion[i] = evaluate(terms, current.dU);
      position[i] = evaluate(terms, current.U);
      terms_size[i] = magnitude(terms, current.U);
      if (rows[i].moving)
        position[i] += evaluate(terms, origin.displacement);
    }
    share({&motion, &position, &terms_size});
  }

  /// Sums vectors over the rows, each with the shares of the bodies of this rank, over all ranks.
  void TimeStepper::share(const std::initializer_list<std::vector<double> *> vectors)
  {
    const Communicator &processes = structure.communicator();
    if (processes.size() == 1)
      return;
    work.clear();
    for (const std::vector<double> *v : vectors)
      work.insert(work.end(), v->begin(), v->end());
    processes.sum(work);
    const double *sums = work.data();
    for (std::vector<double> *v : vectors)
    {
      std::copy(sums, sums + v->size(), v->begin());
      sums += v->size();
    }
  }

  void TimeStepper::solve_rows()
  {
    if (rows.size() == 0)
      return;
    try
    {
      const ComplementarityResult &result = complementarity.solve(problem, schur->matrix());
      current.multiplier = result.solution.multiplier;
      last.iterations = result.iterations;
      last.fallback = result.used_fallback;
    }
    catch (const NotSolved &e)
    {
      fail(e.what());
    }
    catch (const ContradictoryRows &e)
    {
      fail("the links " + rows.names(e.rows()) +
               " contradict each other: no contact forces satisfy them all. Remove one of them, "
               "give "
               "one a finite "
               "stiffness, or check the initial gaps",
           e.rows().empty() ? "" : rows.origin(e.rows().front()));
    }
  }

  /// New displacement, velocity and acceleration of a body, and its force balance.
  void TimeStepper::accept(const std::size_t k)
  {
    const StepCoefficients &c = coefficients;
    const std::size_t n = increment[k].size();
    if (structure[k].has_moving_constraints())
      for (const ConstrainedDof &constraint : structure[k].constraints())
        increment[k][constraint.dof] = lift[k][constraint.dof];

    old_A[k].swap(current.A[k]);
    old_balance[k].swap(current.balance[k]);
    current.V_old[k].swap(current.V[k]);
    current.dU[k].swap(increment[k]);
    const double *dU = current.dU[k].data(), *v = predictor_v[k].data(), *a = predictor_a[k].data();
    double *U = current.U[k].data(), *V = current.V[k].data(), *A = current.A[k].data();
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i)
    {
      U[i] += dU[i];
      V[i] = c.velocity * dU[i] + v[i];
      A[i] = c.acceleration * dU[i] + a[i];
    }
  }

  void TimeStepper::update_rows()
  {
    const StepCoefficients &c = coefficients;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const Row &row = rows[i];
      double &gap = current.geometric_gap[i];
      if (row.moving)
        gap = moving_gap(i);
      else
        gap += motion[i];

      State::LinkSpring &spring = current.link_springs[i];
      const double known_v = c.v_V * spring.v + c.v_A * spring.a + c.v_dU * spring.du;
      const double known_a = c.a_V * spring.v + c.a_A * spring.a + c.a_dU * spring.du;
      const double u = compliance[i] * current.multiplier[i] + link_history[i];
      spring.du = u - spring.u;
      spring.u = u;
      spring.v = c.velocity * spring.du + known_v;
      spring.a = c.acceleration * spring.du + known_a;
      current.gap[i] = gap + spring.u;
    }
  }

  void TimeStepper::certify()
  {
    const Communicator &processes = structure.communicator();
    processes.agree([&] { certify_balance(); });
    const double own_balance = last.balance;
    last.balance = processes.max(own_balance);
    certify_rows();
    if (!(last.balance <= parameters.contact_tolerance))
      processes.agree(
          [&]
          {
            if (!(own_balance < last.balance))
              fail_balance();
          });
  }

  void TimeStepper::certify_balance()
  {
    const StepCoefficients &c = coefficients;
    const double kappa = c.alpha_f / (1. - c.alpha_f);
    const double old = c.alpha_m / (1. - c.alpha_f), now = (1. - c.alpha_m) / (1. - c.alpha_f);

    last.balance = 0.;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      std::copy(P[k].begin(), P[k].end(), current.balance[k].begin());
      std::fill(current.KU[k].begin(), current.KU[k].end(), 0.);
      body.stiffness().vmult_add(1., current.U[k].data(), current.KU[k].data());
    }
    rows.add_forces(current.multiplier, current.balance);
    largest_contact_forces(structure, rows, current.multiplier, contact_force);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      const std::size_t n = body.n_dofs();
      double *r = current.balance[k].data(), *a = increment[k].data();
      const double *KU = current.KU[k].data(), *A = current.A[k].data(), *A0 = old_A[k].data(),
                   *r0 = old_balance[k].data();
      // P and B N may cancel, and both against the forces of the reference: each counts.
      PerKind force = largest(body, P[k]);
      for (int kind = 0; kind < 2; ++kind)
        force[kind] += contact_force[k][kind] + reference_force[k][kind];
      body.damping().vmult_add(-1., current.V[k].data(), r);
      work.resize(n);
      double *residual = work.data();
#pragma omp simd
      for (std::size_t i = 0; i < n; ++i)
      {
        r[i] -= KU[i];
        a[i] = now * A[i] + old * A0[i];
        residual[i] = -r[i] - kappa * r0[i];
      }
      body.mass().vmult_add(1., a, residual);
      for (const ConstrainedDof &constraint : body.constraints())
        residual[constraint.dof] = 0.;

      PerKind increments = largest(body, current.dU[k]);
      for (double &d : increments)
        d *= c.mass_factor();
      const PerKind error = largest(body, work), inertia = norms[k][0].times(increments),
                    velocity = largest(body, current.V[k]),
                    displacement = largest(body, current.U[k]),
                    damping = norms[k][1].times(velocity),
                    stiffness = norms[k][2].times(displacement);
      for (int kind = 0; kind < 2; ++kind)
        if (!(std::max({force[kind], velocity[kind], displacement[kind]}) <= largest_number) ||
            std::isnan(velocity[kind]) || std::isnan(displacement[kind]))
        {
          std::ostringstream when;
          when << "at t = " << current.time << " s: ";
          check_size(body, force, displacement, velocity, when.str());
        }
      for (int kind = 0; kind < 2; ++kind)
      {
        const double size = force[kind] + inertia[kind] + damping[kind] + stiffness[kind];
        const double relative = error[kind] == 0. ? 0. : error[kind] / size;
        if (!(relative <= last.balance) && !std::isnan(last.balance))
        {
          last.balance = relative;
          last.worst_body = k;
        }
      }
    }
  }

  void TimeStepper::certify_rows()
  {
    // Gaps from the increments of the displacements, not from F N + d; and gaps so carried must not
    // drift away from the displacements, measured by the terms that these are summed from.
    last.complementarity = 0.;
    if (rows.size() > 0)
    {
      MixedComplementaritySolution recomputed;
      recomputed.multiplier = current.multiplier;
      recomputed.gap = current.gap;
      const ComplementarityResidual result = residual(problem, schur->matrix(), recomputed);
      last.complementarity = result.max;
      last.worst_row =
          std::max_element(result.rows.begin(), result.rows.end()) - result.rows.begin();
      for (std::size_t i = 0; i < rows.n_fixed(); ++i)
      {
        gap_terms[i] = std::max(gap_terms[i], std::fabs(reference_gap[i]) + terms_size[i]);
        const double drift = std::fabs(reference_gap[i] + position[i] - current.geometric_gap[i]),
                     relative = drift == 0. ? 0. : drift / gap_terms[i];
        if (!(relative <= last.complementarity) && !std::isnan(last.complementarity))
        {
          last.complementarity = relative;
          last.worst_row = i;
        }
      }
    }

    if (!(last.complementarity <= parameters.contact_tolerance))
    {
      std::ostringstream out;
      out << "link '" << rows[last.worst_row].name << "' misses the contact tolerance: residual "
          << last.complementarity << " > " << parameters.contact_tolerance
          << ". Take a smaller step or raise 'Contact tolerance'";
      fail(out.str(), rows.origin(last.worst_row));
    }
  }

  void TimeStepper::fail_balance() const
  {
    std::ostringstream out;
    out << "body '" << structure[last.worst_body].name()
        << "' misses the contact tolerance in its equation of motion: residual " << last.balance
        << " > " << parameters.contact_tolerance
        << ". Check stiffness and mass for extreme ratios, or raise 'Contact tolerance'";
    fail(out.str(), structure[last.worst_body].origin());
  }

  void TimeStepper::fail(const std::string &what, const std::string &entry) const
  {
    std::ostringstream out;
    out << "at t = " << current.time << " s: " << what << ".";
    throw EntryError(entry, out.str());
  }
} // namespace taut
