// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/velocity_projection.h"
#include "base/dot.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Relative rates that are rounding: steps of thousands of operations, each with 1e-16.
    constexpr double rounding_of_rates = 1e-12;

    /// Part of the largest terms of a rate so far, and of the largest rate with the kinetic energy,
    /// below which rates count as rest. Rates are solved to 1e-12 of their terms: with this part,
    /// to 1e-15 of the largest ones, which is rounding.
    constexpr double rest = 1e-3;
  } // namespace

  VelocityProjection::VelocityProjection(const Structure &structure, const Constraints &constraints,
                                         const SolverParameters &parameters,
                                         const Reference &reference)
      : structure(structure), constraints(constraints),
        masses(structure, constraints, parameters, reference),
        complementarity(parameters.complementarity), dV(structure.zero())
  {
    const std::size_t n = constraints.size();
    for (std::vector<double> *v : {&p, &q, &change, &rate, &work_of_rows, &largest_scale})
      v->assign(n, 0.);
    takes_part.assign(n, 0);
    has_no_mass = constraints.without_mass();
    problem.shared = constraints.shared();
    problem.free_gap.resize(n);
    problem.gap_scale.resize(n);
    problem.cones.assign(n, Cone::zero());
    std::size_t n_quasi_static = 0;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      quasi_static.emplace_back();
      const std::vector<unsigned int> constrained = body.constrained_dofs(),
                                      all = body.quasi_static_dofs();
      std::set_difference(all.begin(), all.end(), constrained.begin(), constrained.end(),
                          std::back_inserter(quasi_static.back()));
      n_quasi_static += quasi_static.back().size();
    }
    some_quasi_static = structure.communicator().any(n_quasi_static > 0);
  }

  void VelocityProjection::prepare(const StepCoefficients &coefficients, const double tau,
                                   const std::vector<double> &S, ComplementarityOperator &F,
                                   const bool linear)
  {
    is_linear = linear;
    c = coefficients;
    step = tau;
    masses.prepare(c, S, F, is_linear);
  }

  /// Sets which constraints take part and their impulses. False if all rates satisfy conditions.
  bool VelocityProjection::has_to_act(const ContactStep &contacts, const State &state)
  {
    bool acts = false;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      takes_part[i] = 0;
      p[i] = contacts.is_mean(i) ? step * state.multiplier[i] : 0.;
      const bool is_spring = constraints[i].cone.is_free() && !constraints[i].spring.is_rigid();
      if (!contacts.is_mean(i) || has_no_mass[i] || is_spring ||
          !constraints[i].cone.is_closed(p[i]) || !masses.takes_part(i))
        continue;
      takes_part[i] = 1;
      if (contacts.remains_in_contact(i, state))
        continue;
      acts = acts || std::fabs(state.rate[i]) >
                         rounding_of_rates * (contacts.velocity_sizes()[i] +
                                              std::fabs(state.rate[i] - contacts.velocities()[i]));
      acts = acts || (constraints[i].cone.restitution(c.restitution) > 0. &&
                      contacts.rates_before_step()[i] < 0.);
    }
    return constraints.any(acts);
  }

  double VelocityProjection::kinetic_energy(const State &state)
  {
    double sum = 0.;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      structure[k].mass().vmult(state.V[k].data(), dV[k].data());
      sum += .5 * dot_in_lanes(state.V[k], dV[k]);
    }
    structure.communicator().sum(&sum, 1);
    return std::max(0., sum);
  }

  /// Sets d = D'* - (f + softening) p for the constraints that take part.
  void VelocityProjection::set_problem(const State &state)
  {
    const ComplementarityOperator &f = masses.f();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (!(f.diagonal(i) > 0.))
        takes_part[i] = 0;
      if (!takes_part[i])
        p[i] = 0.;
      problem.cones[i] = takes_part[i] ? constraints[i].cone : Cone::zero();
    }
    const double momentum = std::sqrt(2. * kinetic_energy(state));
    f.apply(p, change);
    f.apply_absolute(p, work_vector);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      rate[i] = state.rate[i];
      problem.free_gap[i] = rate[i] - change[i];
      problem.gap_scale[i] += work_vector[i];
      largest_scale[i] = std::max(largest_scale[i], problem.gap_scale[i]);
      problem.gap_scale[i] = std::max({problem.gap_scale[i], rest * largest_scale[i],
                                       rest * momentum * std::sqrt(std::max(0., f.diagonal(i)))});
    }
  }

  VelocityProjection::Residual VelocityProjection::project(ContactStep &contacts, State &state,
                                                           ComplementarityOperator &F)
  {
    std::fill(work_of_rows.begin(), work_of_rows.end(), 0.);
    masses.follow(contacts.compliance(), F);
    if (some_quasi_static)
    {
      move_quasi_static(state);
      contacts.update_rates(state);
    }
    if (!has_to_act(contacts, state))
      return {};
    masses.update(state);
    problem.gap_scale = contacts.velocity_sizes();
    set_problem(state);
    solve(contacts, state);
    return set_velocities(contacts, state);
  }

  /// Solves for P - p.
  void VelocityProjection::solve(const ContactStep &contacts, const State &state)
  {
    if (!is_linear)
      complementarity.begin_search();
    const auto find = [&](std::vector<double> &impulses)
    {
      impulses = complementarity.solve(problem, masses.f()).solution.multiplier;
      for (std::size_t i = 0; i < impulses.size(); ++i)
        impulses[i] -= p[i];
    };
    find(q);
    bool rebounds = false;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (takes_part[i] && constraints[i].cone.may_open() && contacts.rates_before_step()[i] < 0. &&
          c.restitution > 0. && masses.compliance(i) == 0.)
      {
        problem.free_gap[i] += c.restitution * contacts.rates_before_step()[i];
        rebounds = true;
      }
    if (!constraints.any(rebounds))
      return;
    std::vector<double> difference;
    find(difference);
    for (std::size_t i = 0; i < q.size(); ++i)
      difference[i] -= q[i];
    add_largest_parts(contacts, state, difference);
  }

  /// Adds to q, for each group of connected bodies, the largest part s in [0, 1] of the impulses r
  /// = @p rebounding for which the contacts of the group give no energy. In a step they do the work
  /// p . (D - D_0) / step + q . (D'* + D') / 2 with D' = D'* + f q, where q stands for q + s r.
  /// This is a convex parabola a s^2 + b s + c in s, not positive at s = 0.
  void VelocityProjection::add_largest_parts(const ContactStep &contacts, const State &state,
                                             const std::vector<double> &rebounding)
  {
    const auto response = [&](const std::vector<double> &impulses)
    {
      std::vector<double> result;
      masses.f().apply(impulses, result);
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] -= masses.compliance(i) * impulses[i];
      return result;
    };
    const std::vector<double> of_plain = response(q), of_rebounding = response(rebounding);
    // Sliding constraints may be on other bodies than before.
    if (!connected || !constraints.sliding_rows().empty())
      connected = std::make_unique<ConnectedBodies>(structure, constraints);
    const ConnectedBodies &groups = *connected;
    std::vector<double> works(3 * groups.n_groups(), 0.); // a, b, c of each group
    for (std::size_t i = 0; i < q.size(); ++i)
    {
      if (!constraints.counts(i))
        continue;
      double *const own = &works[3 * groups.of_constraint(i)];
      own[0] += .5 * rebounding[i] * of_rebounding[i];
      own[1] += rebounding[i] * (state.rate[i] + of_plain[i]);
      own[2] += q[i] * (state.rate[i] + .5 * of_plain[i]);
      if (!constraints.slides(i))
        own[2] += p[i] * contacts.increments()[i] / step;
    }
    constraints.add_up(works);
    const auto largest_part = [&](const std::size_t group)
    {
      const double a = works[3 * group], b = works[3 * group + 1], c = works[3 * group + 2];
      if (a + b + c <= 0. || !(a > 0.))
        return 1.;
      const double discriminant = b * b - 4. * a * std::min(0., c);
      return std::min(1., std::max(0., (-b + std::sqrt(discriminant)) / (2. * a)));
    };
    for (std::size_t i = 0; i < q.size(); ++i)
      q[i] += largest_part(groups.of_constraint(i)) * rebounding[i];
  }

  /// Sets the mean velocity over the step: that of the scheme alternates.
  void VelocityProjection::move_quasi_static(State &state)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::fill(dV[k].begin(), dV[k].end(), 0.);
      for (const unsigned int dof : quasi_static[k])
        dV[k][dof] = state.dU[k][dof] / step - state.V[k][dof];
    }
    change_velocities(state);
  }

  void VelocityProjection::change_velocities(State &state)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      for (std::size_t i = 0; i < dV[k].size(); ++i)
        state.V[k][i] += dV[k][i];
      structure[k].damping().vmult_add(-1., dV[k].data(), state.balance[k].data());
    }
  }

  VelocityProjection::Residual VelocityProjection::set_velocities(ContactStep &contacts,
                                                                  State &state)
  {
    for (std::vector<double> &v : dV)
      std::fill(v.begin(), v.end(), 0.);
    constraints.add_forces(q, dV);
    masses.solve(dV);
    change_velocities(state);
    work_vector = contacts.velocities();
    contacts.update_rates(state);
    masses.f().apply(q, change);
    Residual found;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      work_of_rows[i] = .5 * q[i] * (work_vector[i] + contacts.velocities()[i]);
      if (!takes_part[i])
        continue;
      const double expected = rate[i] + change[i] - masses.compliance(i) * q[i],
                   size = problem.gap_scale[i] + std::fabs(rate[i]) + std::fabs(expected),
                   error = std::fabs(state.rate[i] - expected),
                   relative = error == 0. ? 0. : error / size;
      if (!(relative <= found.largest) && !std::isnan(found.largest))
        found = {relative, i};
      state.multiplier[i] = (p[i] + q[i]) / step;
    }
    const double largest = constraints.max(found.largest);
    if (!(found.largest >= largest) && !std::isnan(found.largest))
      found.worst = no_link;
    found.largest = largest;
    return found;
  }
} // namespace taut
