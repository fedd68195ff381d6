// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/dot.h"
#include "time/matrix_norms.h"
#include "time/nonlinear_step.h"
#include "time/step.h"
#include "time/stored_row_records.h"
#include <taut/base/archive.h>
#include <taut/time/energy_account.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace taut
{
  namespace
  {
    /// Steps between two measurements of the scale of contact energy: one costs a tenth of a step,
    /// and all of them less than a percent of the run.
    constexpr long steps_between_scales = 16;

    /// Part of the energy of the reference that is rounding in a long run at rest: gains of 1e-16
    /// in each step come to the warning of a percent after 1e6 steps.
    constexpr double rounding_of_energy = 1e-8;

    /// Part of the energy of a nonlinear body that is rounding in a step, and the rotation through
    /// which rounding of moments may do work [rad].
    constexpr double rounding_of_step = 1e-14, noise_turn = 1e-2;

    /// Part of the energy of a contact below which a step does not change it. A choice: the impulse
    /// after the last larger change is not one of the impact. A smaller part adds impulse of rest,
    /// which hides errors of momentum.
    constexpr double small_change = 1e-2;

    /// Part of its speed at which a body has got most of the impulse of an impact.
    constexpr double slow = .5;
  } // namespace

  EnergyAccount::EnergyAccount(const Structure &structure, const Constraints &constraints,
                               const Reference &reference, const State &start)
      : structure(structure), constraints(constraints), reference(reference),
        connected(structure, constraints), masses(total_masses(structure)),
        rows(constraints.size()), groups(connected.n_groups()), kinetic(groups.size(), 0.)
  {
    bool moves_here = false;
    for (std::size_t k = 0; k < structure.size(); ++k)
      moves_here = moves_here || structure[k].has_moving_constraints();
    for (const std::size_t i : constraints.turning_rows())
      moves_here = moves_here || constraints.turning(i).length_at;
    supports_move = structure.communicator().any(moves_here);
    work.resize(rows.size());
    terms.resize(rows.size());
    constraints.share_of_motions(reference.displacement, work, terms);
    constraints.sum(terms);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      Row &row = rows[i];
      row.multiplier = start.multiplier[i];
      row.gap = start.complementarity_gap[i] - constraints.distance_beyond(i, start.time);
      row.u = start.springs[i].u;
      row.noise = rounding_of_gaps * (terms[i] + std::fabs(constraints[i].gap));
      row.begin = start.time;
    }
    set_first_one_sided();
    set_rest(start);
    measure_scale(start, {});
    add_kinetic_energies(start.V, kinetic);
    structure.communicator().sum(kinetic);
  }

  void EnergyAccount::set_first_one_sided()
  {
    std::vector<std::size_t> first(groups.size(), no_link);
    std::vector<double> has_one(groups.size(), 0.);
    for (std::size_t i = rows.size(); i-- > 0;)
      if (const std::size_t g = connected.of_constraint(i); constraints[i].cone.may_open())
      {
        first[g] = i;
        has_one[g] = 1.;
      }
    constraints.take_largest(has_one, first);
    for (std::size_t g = 0; g < groups.size(); ++g)
      groups[g].first_one_sided = first[g];
  }

  /// Finds what is rounding, and groups with large motions.
  void EnergyAccount::set_rest(const State &start)
  {
    const std::size_t n = groups.size();
    std::vector<double> n_nonlinear(n, 0.), at_rest(n, 0.), of_step(n, 0.);
    structure.communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < structure.size(); ++k)
          {
            const Substructure &body = structure[k];
            const std::size_t g = connected.of_body(k);
            at_rest[g] +=
                .5 * std::fabs(dot_in_lanes(reference.displacement[k], reference.force[k]));
            if (body.is_linear())
              continue;
            n_nonlinear[g] += 1.;
            of_step[g] += rounding_of_step * body.strain_energy(displacement(reference, start, k)) +
                          noise_turn * body.rounding_of_force(1);
          }
        });
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (constraints.is_own(i))
        at_rest[connected.of_constraint(i)] +=
            std::fabs(start.multiplier[i]) * rows[i].noise / rounding_of_gaps;
    for (std::vector<double> *const sum : {&n_nonlinear, &at_rest, &of_step})
      structure.communicator().sum(*sum);
    for (const std::size_t i : constraints.turning_rows())
      n_nonlinear[connected.of_constraint(i)] += 1.;
    for (std::size_t g = 0; g < n; ++g)
    {
      groups[g].rest = rounding_of_energy * at_rest[g];
      groups[g].rest_of_step = of_step[g];
      groups[g].moves_far = n_nonlinear[g] > 0.;
    }
  }

  bool EnergyAccount::has_large_motions() const
  {
    return std::any_of(groups.begin(), groups.end(),
                       [](const Group &group) { return group.moves_far; });
  }

  void EnergyAccount::measure(Step &step, NonlinearStep &nonlinear, const State &state)
  {
    const StepMethod &method = step.report().method;
    bool on_velocities = false;
    for (std::size_t i = 0; i < rows.size(); ++i)
      on_velocities =
          on_velocities || (constraints[i].cone.may_open() && method.rules[i].is_on_velocity());
    if (method.has_means())
    {
      if (!constraints.any(on_velocities) && (constraints.n_of_all() > 0 || !nonlinear.is_linear()))
        measure_means(step, nonlinear, state);
    }
    else if (!nonlinear.is_linear() && method.c.is_backward_euler())
      measure_at_ends(step, nonlinear, state);
  }

  /// Adds V . M V / 2 of each body to its group.
  void EnergyAccount::add_kinetic_energies(const BodyVectors &V, std::vector<double> &of_groups)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      work.resize(V[k].size());
      structure[k].mass().vmult(V[k].data(), work.data());
      of_groups[connected.of_body(k)] += .5 * dot_in_lanes(V[k], work);
    }
  }

  void EnergyAccount::add_surplus(NonlinearStep &nonlinear, const double theta, const State &state,
                                  double *const of_groups)
  {
    const auto add = [&]
    {
      for (const std::size_t k : nonlinear.bodies().indices())
        of_groups[connected.of_body(k)] += nonlinear.bodies().energy_surplus(k, theta, state);
    };
    structure.communicator().agree(std::ref(add)); // a reference allocates nothing
  }

  /// Contribution of a constraint with a mean force: the change of its spring energy, or minus its
  /// work if it slides.
  double EnergyAccount::gain_of_spring(const std::size_t i, const State &state,
                                       const StepReport &report) const
  {
    const ConstraintSpring &own = constraints[i].spring;
    if (!report.is_mean(i))
      return 0.;
    if (constraints.slides(i))
      return -report.work[i];
    if (own.is_rigid())
      return 0.;
    const RowStates::Spring &spring = state.springs[i];
    const double before = spring.u - spring.du;
    return own.law ? own.law->mean_force(before, spring.u) * spring.du
                   : .5 * own.stiffness * (spring.u * spring.u - before * before);
  }

  void EnergyAccount::measure_means(Step &step, NonlinearStep &nonlinear, const State &state)
  {
    const std::size_t n = groups.size();
    StepReport &report = step.report();
    sums.assign(2 * n, 0.);
    add_surplus(nonlinear, .5, state, sums.data() + n);
    for (std::size_t k = 0; k < structure.size(); ++k)
      sums[n + connected.of_body(k)] -= step.balance().work(k);
    add_kinetic_energies(state.V, sums);
    for (const std::size_t i : constraints.rows_but_cuts())
      if (constraints.is_own(i))
        sums[n + connected.of_constraint(i)] += gain_of_spring(i, state, report);
    structure.communicator().sum(sums);
    report.gains.assign(n, 0.);
    for (std::size_t g = 0; g < n; ++g)
    {
      if (!supports_move)
        report.gains[g] = sums[g] - kinetic[g] + sums[n + g];
      kinetic[g] = sums[g];
    }
  }

  void EnergyAccount::measure_at_ends(Step &step, NonlinearStep &nonlinear, const State &state)
  {
    std::vector<double> lost(groups.size(), 0.);
    sums.assign(groups.size(), 0.);
    add_surplus(nonlinear, 1., state, sums.data());
    BodyVectors change = state.V;
    for (std::size_t k = 0; k < change.size(); ++k)
      for (std::size_t i = 0; i < change[k].size(); ++i)
        change[k][i] -= state.V_old[k][i];
    add_kinetic_energies(change, lost);
    for (std::size_t g = 0; g < sums.size(); ++g)
      sums[g] -= lost[g];
    structure.communicator().sum(sums);
    for (const std::size_t i : constraints.turning_rows())
      sums[connected.of_constraint(i)] +=
          nonlinear.constraints().surplus(i, state.multiplier[i], step.contacts().increments()[i]);
    step.report().gains = sums;
  }

  void EnergyAccount::record(const State &state, const StepReport &report, const BodyVectors &P)
  {
    ++n_steps;
    add_impulses(state);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (constraints[i].cone.may_open())
        record_row(i, state, report);
    add_gains(report);
    if (n_steps < steps_between_scales || n_steps % steps_between_scales == 0)
      measure_scale(state, P);
  }

  /// Adds the impulses of the step to the groups.
  void EnergyAccount::add_impulses(const State &state)
  {
    sums.assign(2 * groups.size(), 0.);
    for (const std::size_t i : constraints.rows_but_cuts())
      if (state.multiplier[i] > 0. && constraints[i].cone.may_open() && constraints.counts(i))
        sums[2 * connected.of_constraint(i) + (constraints[i].rotational ? 1 : 0)] +=
            state.multiplier[i] * state.last_step;
    constraints.add_up(sums);
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (std::size_t kind = 0; kind < 2; ++kind)
        groups[g].impulse[kind] += sums[2 * g + kind];
  }

  /// Without a unilateral constraint, no contact can have caused a gain.
  void EnergyAccount::add_gains(const StepReport &report)
  {
    for (std::size_t g = 0; g < report.gains.size(); ++g)
    {
      const double gain = std::max(0., report.gains[g]);
      if (groups[g].first_one_sided != no_link && report.method.has_means())
        groups[g].contact_gains += gain;
      if (groups[g].moves_far)
        groups[g].motion_gains += gain;
    }
  }

  double EnergyAccount::impulse_of(const std::size_t i) const
  {
    return groups[connected.of_constraint(i)].impulse[constraints[i].rotational ? 1 : 0];
  }

  /// Energy that a constraint gives in a step, beyond its spring and damper.
  double EnergyAccount::gain(const std::size_t i, const State &state,
                             const StepReport &report) const
  {
    const ConstraintData &constraint = constraints[i];
    const Row &row = rows[i];
    // What a contact stores is lost where its wire ends, and not by the step.
    if (constraints.distance_beyond(i, state.time) > 0.)
      return 0.;
    // A winch gives energy, and is none of the step.
    if (constraints.turns(i) && constraints.turning(i).length_at)
      return 0.;
    const double change = state.complementarity_gap[i] - row.gap;
    const bool is_mean = report.is_mean(i);
    if (is_mean && !constraints.slides(i))
    {
      if (constraint.spring.is_rigid())
        return report.work[i];
      const State::Spring &spring = state.springs[i];
      const double with_damper =
          report.work[i] + constraint.spring.energy(spring.u) - constraint.spring.energy(row.u);
      // A contact with a damper ends at zero force. The damper takes the remaining energy of the
      // spring, all of it within part of a step.
      if (constraint.spring.damping > 0. && !(row.multiplier > 0. && state.multiplier[i] > 0.))
        return std::max(0., with_damper);
      return with_damper + constraint.spring.damping * spring.du * spring.du / state.last_step;
    }
    if (!(std::fabs(change) > row.noise))
      return 0.;
    return is_mean ? state.multiplier[i] * change
                   : .5 * (row.multiplier + state.multiplier[i]) * change;
  }

  void EnergyAccount::add_contact(Contacts &contacts, const Row &row, const double end)
  {
    const double energy = std::fabs(row.closing);
    (row.closing > 0. ? contacts.given : contacts.taken) += energy;
    if (row.fastest > 0.)
      contacts.momentum = std::max(contacts.momentum, 2. * energy / row.fastest);
    contacts.impulse = std::max(contacts.impulse, row.impulse_until - row.impulse_before);
    if (!(energy > contacts.largest))
      return;
    contacts.largest = energy;
    contacts.begin = row.begin;
    contacts.end = end;
  }

  void EnergyAccount::record_row(const std::size_t i, const State &state, const StepReport &report)
  {
    Row &row = rows[i];
    // A closed elastic constraint moves with its spring. Rounding of the gap has no speed.
    const double gap = state.complementarity_gap[i] - constraints.distance_beyond(i, state.time);
    const double moved = std::fabs(gap - row.gap) + std::fabs(state.springs[i].u - row.u),
                 N = state.multiplier[i], rate = std::max(moved, row.noise) / state.last_step;
    if (row.multiplier > 0. || N > 0.)
    {
      if (!(row.multiplier > 0.))
      {
        row.begin = state.time - state.last_step;
        row.fastest = row.rate;
        row.impulse_before = row.impulse;
        row.is_fast = true;
      }
      row.fastest = std::max(row.fastest, rate);
      const RowRule &rule = report.method.rules[i];
      double change = 0.;
      if (!constraints[i].spring.is_rigid())
        change = this->gain(i, state, report);
      else if (!rule.is_mean() || rule.is_on_velocity()) // other gains count in groups
        change = std::max(0., this->gain(i, state, report));
      row.closing += change;
      if (row.is_fast || std::fabs(change) > small_change * std::fabs(row.closing))
        row.impulse_until = impulse_of(i);
      row.is_fast = row.is_fast && moved > row.noise && rate > slow * row.fastest;
      if (!(N > 0.))
      {
        add_contact(row.contacts, row, state.time);
        row.contacts.step = state.last_step;
        row.contacts.shortest = std::min(row.contacts.shortest, state.time - row.begin);
        row.closing = 0.;
      }
    }
    row.multiplier = N;
    row.rate = rate;
    row.end = state.time;
    row.gap = gap;
    row.u = state.springs[i].u;
    row.impulse = impulse_of(i);
  }

  /// With the contact under way.
  EnergyAccount::Contacts EnergyAccount::contacts_of(const std::size_t i) const
  {
    Contacts result = rows[i].contacts;
    if (rows[i].closing != 0.)
      add_contact(result, rows[i], rows[i].end);
    return result;
  }

  /// Energy that the loads give a free body in one step: at rest, motions are rounding of it [J].
  double EnergyAccount::energy_of_loads(const std::size_t k, const std::vector<double> &P,
                                        const double step) const
  {
    if (!(masses[k] > 0.))
      return 0.;
    double force = 0.;
    for (unsigned int i = 0; i < P.size(); ++i)
      if (structure[k].kind(i) == 0)
        force += std::fabs(P[i] + reference.force[k][i]);
    const double speed = step * force / masses[k];
    return .5 * masses[k] * speed * speed;
  }

  void EnergyAccount::measure_scale(const State &state, const BodyVectors &P)
  {
    const std::size_t n = groups.size();
    sums.assign(3 * n, 0.);
    springs.assign(n, 0.);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      work.assign(body.n_dofs(), 0.);
      body.mass().vmult_add(.5, state.V[k].data(), work.data());
      sums[connected.of_body(k)] += dot_in_lanes(work, state.V[k]);
      sums[n + connected.of_body(k)] += .5 * dot_in_lanes(state.U[k], state.KU[k]);
      if (!P.empty())
        sums[2 * n + connected.of_body(k)] += energy_of_loads(k, P[k], state.last_step);
    }
    structure.communicator().sum(sums);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (constraints.counts(i))
        springs[connected.of_constraint(i)] += constraints[i].spring.energy(state.springs[i].u);
    constraints.add_up(springs);
    for (std::size_t g = 0; g < n; ++g)
    {
      groups[g].kinetic = std::max(groups[g].kinetic, sums[g]);
      groups[g].strain = std::max(groups[g].strain, std::fabs(sums[n + g]));
      groups[g].springs = std::max(groups[g].springs, springs[g]);
      groups[g].loads = std::max(groups[g].loads, sums[2 * n + g]);
    }
    work.assign(rows.size(), 0.);
    constraints.share_of_motions(state.U, work, terms);
    constraints.sum(terms);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].noise = std::max(rows[i].noise, rounding_of_gaps * terms[i]);
  }

  template <typename Archive>
  void EnergyAccount::store(Archive &archive)
  {
    store_of_rows(archive, constraints, rows);
    for (Group &group : groups)
      archive &group;
    archive &kinetic &n_steps;
  }

  template void EnergyAccount::store(OutputArchive &);
  template void EnergyAccount::store(InputArchive &);
} // namespace taut
