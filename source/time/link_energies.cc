// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/base/dot.h>
#include <taut/time/link_energies.h>
#include <taut/time/matrix_norms.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Part of the energy of the reference that is rounding in a long run at rest.
    constexpr double rounding_of_energy = 1e-8;

    /// Part of the energy of a contact below which a step does not change it.
    constexpr double small_change = 1e-2;

    /// Part of its speed at which a body has got most of the impulse of an impact.
    constexpr double slow = .5;
  } // namespace

  LinkEnergies::LinkEnergies(const Structure &structure, const Constraints &constraints,
                             const Reference &reference, const State &start)
      : structure(structure), constraints(constraints), reference(reference),
        connected(structure, constraints), masses(total_masses(structure)),
        rows(constraints.size()), energies(connected.n_groups())
  {
    work.resize(rows.size());
    terms.resize(rows.size());
    constraints.share_of_motions(reference.displacement, work, terms);
    structure.communicator().sum(terms);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      rows[i].multiplier = start.multiplier[i];
      rows[i].gap = start.gap[i] - constraints.distance_beyond(i, start.time);
      rows[i].u = start.link_springs[i].u;
      rows[i].noise = rounding_of_gaps * (terms[i] + std::fabs(constraints[i].gap));
      rows[i].begin = start.time;
    }
    measure_rest(start);
    measure_scale(start, {});
  }

  void LinkEnergies::measure_rest(const State &start)
  {
    std::vector<double> sums(energies.size(), 0.);
    for (std::size_t k = 0; k < structure.size(); ++k)
      sums[connected.of_body(k)] +=
          .5 * std::fabs(dot_in_lanes(reference.displacement[k], reference.force[k]));
    structure.communicator().sum(sums);
    for (std::size_t i = 0; i < rows.size(); ++i)
      sums[connected.of_constraint(i)] +=
          std::fabs(start.multiplier[i]) * rows[i].noise / rounding_of_gaps;
    for (std::size_t g = 0; g < energies.size(); ++g)
      energies[g].rest = rounding_of_energy * sums[g];
  }

  /// Energy that a constraint gives in a step, beyond its spring and damper.
  double LinkEnergies::gain(const std::size_t i, const State &state,
                            const StepReport &report) const
  {
    const ConstraintData &constraint = constraints[i];
    const Row &row = rows[i];
    // What a contact stores is lost where its wire ends, and not by the step.
    if (constraints.distance_beyond(i, state.time) > 0.)
      return 0.;
    const double change = state.gap[i] - row.gap;
    const bool is_mean = report.is_mean(i);
    if (is_mean && !constraints.slides(i))
    {
      if (constraint.spring.is_rigid())
        return report.work[i];
      const State::LinkSpring &spring = state.link_springs[i];
      const double with_damper = report.work[i] + constraint.spring.energy(spring.u) -
                                 constraint.spring.energy(row.u);
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

  void LinkEnergies::add_contact(Account &account, const Row &row, const double end)
  {
    const double energy = std::fabs(row.closing);
    (row.closing > 0. ? account.given : account.taken) += energy;
    if (row.fastest > 0.)
      account.momentum = std::max(account.momentum, 2. * energy / row.fastest);
    account.impulse = std::max(account.impulse, row.impulse_until - row.impulse_before);
    if (!(energy > account.largest))
      return;
    account.largest = energy;
    account.begin = row.begin;
    account.end = end;
  }

  void LinkEnergies::record(const State &state, const StepReport &report)
  {
    const auto impulse_of = [&](const std::size_t i) -> double &
    { return energies[connected.of_constraint(i)].impulse[constraints[i].rotational ? 1 : 0]; };
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (state.multiplier[i] > 0. && constraints[i].cone.may_open())
        impulse_of(i) += state.multiplier[i] * state.last_step;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      if (!constraints[i].cone.may_open())
        continue;
      Row &row = rows[i];
      // A closed elastic constraint moves with its spring. Rounding of the gap has no speed.
      const double gap = state.gap[i] - constraints.distance_beyond(i, state.time);
      const double moved = std::fabs(gap - row.gap) + std::fabs(state.link_springs[i].u - row.u),
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
          change = gain(i, state, report);
        else if (!rule.is_mean() || rule.is_on_velocity()) // other gains count in groups
          change = std::max(0., gain(i, state, report));
        row.closing += change;
        if (row.is_fast || std::fabs(change) > small_change * std::fabs(row.closing))
          row.impulse_until = impulse_of(i);
        row.is_fast = row.is_fast && moved > row.noise && rate > slow * row.fastest;
        if (!(N > 0.))
        {
          add_contact(row.account, row, state.time);
          row.account.step = state.last_step;
          row.account.shortest = std::min(row.account.shortest, state.time - row.begin);
          row.closing = 0.;
        }
      }
      row.multiplier = N;
      row.rate = rate;
      row.end = state.time;
      row.gap = gap;
      row.u = state.link_springs[i].u;
      row.impulse = impulse_of(i);
    }
  }

  LinkEnergies::Account LinkEnergies::account(const std::size_t i) const
  {
    const Row &row = rows[i];
    Account result = row.account;
    if (row.closing != 0.)
      add_contact(result, row, row.end);
    return result;
  }

  /// Energy that the loads give a free body in one step: at rest, motions are rounding of it [J].
  double LinkEnergies::energy_of_loads(const std::size_t k, const std::vector<double> &P,
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

  void LinkEnergies::measure_scale(const State &state, const BodyVectors &P)
  {
    const std::size_t n = energies.size();
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
      springs[connected.of_constraint(i)] += constraints[i].spring.energy(state.link_springs[i].u);
    for (std::size_t g = 0; g < n; ++g)
    {
      energies[g].kinetic = std::max(energies[g].kinetic, sums[g]);
      energies[g].strain = std::max(energies[g].strain, std::fabs(sums[n + g]));
      energies[g].springs = std::max(energies[g].springs, springs[g]);
      energies[g].loads = std::max(energies[g].loads, sums[2 * n + g]);
    }
    work.assign(rows.size(), 0.);
    constraints.share_of_motions(state.U, work, terms);
    structure.communicator().sum(terms);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].noise = std::max(rows[i].noise, rounding_of_gaps * terms[i]);
  }

  double LinkEnergies::scale(const std::size_t group) const
  {
    const Energies &e = energies[group];
    return e.kinetic + e.strain + e.springs + e.loads + e.rest;
  }

  template <typename Archive>
  void LinkEnergies::store(Archive &archive)
  {
    for (Row &row : rows)
      archive &row;
    for (Energies &e : energies)
      archive &e;
  }

  void LinkEnergies::save(OutputArchive &archive)
  {
    store(archive);
  }

  void LinkEnergies::load(InputArchive &archive)
  {
    store(archive);
  }
} // namespace taut
