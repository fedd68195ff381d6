// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/time/contact_measures.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Steps between two measurements of the scale of contact energy: one costs a tenth of a step.
    constexpr long steps_between_scales = 16;

    /// Motions of a step that a condition on velocities may leave as a gap: of this step and the
    /// next.
    constexpr double most_steps_of_motion = 2.;

    /// Part of the energy of a nonlinear body that is rounding in a step, and the rotation through
    /// which rounding of moments may do work [rad].
    constexpr double rounding_of_step = 1e-14, noise_turn = 1e-2;

    /// Bound of the highest angular frequency at each DoF from the diagonals, 2 sqrt(K_jj / M_jj);
    /// 0 without mass or stiffness [rad/s].
    std::vector<double> frequencies(const Substructure &body)
    {
      std::vector<double> k(body.n_dofs(), 0.), m(body.n_dofs(), 0.);
      const auto diagonal = [](std::vector<double> &d)
      {
        return [&d](const unsigned int i, const unsigned int j, const double value)
        {
          if (i == j)
            d[i] = value;
        };
      };
      body.stiffness().visit(diagonal(k));
      body.mass().visit(diagonal(m));
      for (std::size_t i = 0; i < k.size(); ++i)
        k[i] = m[i] > 0. ? 2. * std::sqrt(k[i] / m[i]) : 0.;
      return k;
    }
  } // namespace

  ContactMeasures::ContactMeasures(const Structure &structure, const Constraints &constraints,
                                   const Reference &reference, const State &start)
      : structure(structure), constraints(constraints), reference(reference),
        forces(constraints.size()), energies(structure, constraints, reference, start)
  {
    const std::vector<double> times = resolved_times();
    const std::size_t n = energies.groups().n_groups();
    first_one_sided.assign(n, no_link);
    for (std::size_t i = constraints.size(); i-- > 0;)
    {
      forces[i].window = times[i];
      forces[i].last = forces[i].mean = start.multiplier[i];
      forces[i].impulses.push_back({start.time, 0.});
      if (constraints[i].cone.may_open())
        first_one_sided[energies.groups().of_constraint(i)] = i;
    }
    contact_gains.assign(n, 0.);
    motion_gains.assign(n, 0.);
    measure_rest(start);
  }

  /// Finds groups with large motions, and their rounding of energy in a step.
  void ContactMeasures::measure_rest(const State &start)
  {
    const ConnectedBodies &groups = energies.groups();
    const std::size_t n = groups.n_groups();
    std::vector<double> sums(2 * n, 0.);
    structure.communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < structure.size(); ++k)
          {
            const Substructure &body = structure[k];
            if (body.is_linear())
              continue;
            sums[groups.of_body(k)] += 1.;
            sums[n + groups.of_body(k)] +=
                rounding_of_step * body.strain_energy(displacement(reference, start, k)) +
                noise_turn * body.rounding_of_force(1);
          }
        });
    structure.communicator().sum(sums);
    for (const std::size_t i : constraints.turning_rows())
      sums[groups.of_constraint(i)] += 1.;
    for (std::size_t g = 0; g < n; ++g)
      moves_far.push_back(sums[g] > 0.);
    rest_of_step.assign(sums.begin() + n, sums.end());
  }

  /// 2 / omega_max of the elements under each unilateral constraint; 0: lumped bodies only.
  std::vector<double> ContactMeasures::resolved_times() const
  {
    std::vector<double> highest(constraints.size(), 0.);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      if (structure[k].is_lumped())
        continue;
      const std::vector<double> omega = frequencies(structure[k]);
      for (std::size_t i = 0; i < constraints.size(); ++i)
        for (const Term &term : constraints[i].terms)
          if (term.substructure == k && constraints[i].cone.may_open())
            for (const unsigned int dof : term.form.index)
              highest[i] = std::max(highest[i], omega[dof]);
    }
    for (double &value : highest)
    {
      value = structure.communicator().max(value);
      value = value > 0. ? 2. / value : 0.;
    }
    return highest;
  }

  void ContactMeasures::record(const State &state, const StepReport &report,
                               const BodyVectors &P)
  {
    ++n_steps;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (!constraints[i].cone.may_open())
        continue;
      add_wire_end(i, state);
      add_force(forces[i], state.time, state.last_step, state.multiplier[i]);
      add_gap(i, state, report);
    }
    energies.record(state, report);
    add_gains(report);
    if (n_steps < steps_between_scales || n_steps % steps_between_scales == 0)
      energies.measure_scale(state, P);
  }

  /// Without a unilateral constraint, no contact can have caused a gain.
  void ContactMeasures::add_gains(const StepReport &report)
  {
    for (std::size_t g = 0; g < report.gains.size(); ++g)
    {
      const double gain = std::max(0., report.gains[g]);
      if (first_one_sided[g] != no_link && report.method.has_means())
        contact_gains[g] += gain;
      if (moves_far[g])
        motion_gains[g] += gain;
    }
  }

  void ContactMeasures::add_wire_end(const std::size_t i, const State &state)
  {
    Force &f = forces[i];
    if (f.last <= f.end.force || !(constraints.distance_beyond(i, state.time) > 0.))
      return;
    const State::LinkSpring &spring = state.link_springs[i];
    f.end = {state.time, f.last, constraints[i].spring.energy(spring.u - spring.du)};
  }

  template <typename Archive>
  void ContactMeasures::store(Archive &archive)
  {
    for (Force &f : forces)
    {
      forget_past(f);
      archive &f.impulses &f.impulse &f.mean &f.peak &f.mean_peak &f.event_impulse;
      archive &f.largest_impulse &f.gap &f.motion &f.last &f.end;
    }
    archive &contact_gains &motion_gains &n_steps &found.gap &found.gap_constraint;
    archive &found.gap_drifts &found.resolution &found.resolution_row &found.peak;
    archive &found.mean_peak &found.mean_time;
  }

  void ContactMeasures::save(OutputArchive &archive)
  {
    store(archive);
    energies.save(archive);
  }

  void ContactMeasures::load(InputArchive &archive)
  {
    store(archive);
    energies.load(archive);
  }

  /// Drops the impulses before the window.
  void ContactMeasures::forget_past(Force &force)
  {
    force.impulses.erase(force.impulses.begin(),
                         force.impulses.begin() + static_cast<std::ptrdiff_t>(force.first));
    force.first = 0;
  }

  void ContactMeasures::add_force(Force &force, const double t, const double dt, const double value)
  {
    force.event_impulse = value > 0. ? force.event_impulse + value * dt : 0.;
    force.largest_impulse = std::max(force.largest_impulse, force.event_impulse);
    force.last = force.mean = value;
    force.impulse += value * dt;
    if (force.window > 0.)
    {
      force.impulses.push_back({t, force.impulse});
      while (force.first + 2 < force.impulses.size() &&
             force.impulses[force.first + 1].first <= t - force.window)
        ++force.first;
      if (2 * force.first > force.impulses.size())
        forget_past(force);
    }
    if (force.window > dt)
    {
      const auto &first = force.impulses[force.first], &second = force.impulses[force.first + 1];
      const double begin = std::max(first.first, t - force.window),
                   before = first.second + (second.second - first.second) * (begin - first.first) /
                                               (second.first - first.first);
      force.mean = (force.impulse - before) / force.window;
    }
    force.peak = std::max(force.peak, value);
    force.mean_peak = std::max(force.mean_peak, force.mean);
  }

  void ContactMeasures::add_gap(const std::size_t i, const State &state,
                                const StepReport &report)
  {
    if (!constraints[i].spring.is_rigid())
      return;
    const double gap = state.multiplier[i] > 0. ? std::fabs(state.gap[i]) : -state.gap[i];
    if (gap > found.gap)
    {
      found.gap = gap;
      found.gap_constraint = i;
    }
    // A condition on velocities leaves a gap of about the motion of a step.
    Force &force = forces[i];
    if (report.method.rules[i].is_on_velocity())
      force.motion = std::max(force.motion, state.last_step * std::fabs(state.gap_rate[i]));
    force.gap = std::max(force.gap, gap);
  }

  /// Finds the group with most contact energy, and its worst constraint.
  void ContactMeasures::find_contact_energy(Summary &result) const
  {
    const ConnectedBodies &groups = energies.groups();
    std::vector<double> given = contact_gains, taken(given.size(), 0.), worst(given.size(), 0.);
    std::vector<std::size_t> row = first_one_sided;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (!constraints[i].cone.may_open())
        continue;
      const LinkEnergies::Account account = energies.account(i);
      const std::size_t group = groups.of_constraint(i);
      given[group] += account.given;
      taken[group] += account.taken;
      if (!(account.given + account.taken > worst[group]))
        continue;
      worst[group] = account.given + account.taken;
      row[group] = i;
    }
    for (std::size_t g = 0; g < given.size(); ++g)
    {
      const double energy = given[g] + taken[g], scale = energies.scale(g);
      if (row[g] != no_link && energy > result.relative_energy * scale)
      {
        const LinkEnergies::Account account = energies.account(row[g]);
        result.relative_energy = energy / scale;
        result.contact_energy = energy;
        result.taken = taken[g];
        result.scale = scale;
        result.energy_constraint = row[g];
        result.energy_begin = account.begin;
        result.energy_end = account.end;
        result.contact_time = std::isfinite(account.shortest) ? account.shortest : 0.;
        result.step = account.step;
      }
      const double gain = motion_gains[g] - n_steps * rest_of_step[g];
      result.motion_energy += motion_gains[g];
      if (gain > 0.)
        result.relative_motion_energy = std::max(result.relative_motion_energy, gain / scale);
    }
  }

  void ContactMeasures::find_momentum(Summary &result) const
  {
    const ConnectedBodies &groups = energies.groups();
    struct Worst
    {
      double impulse = 0., momentum = 0.;
      std::size_t constraint = 0;
    };
    std::vector<Worst> worst(contact_gains.size());
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (constraints[i].cone.may_open())
      {
        const LinkEnergies::Account account = energies.account(i);
        Worst &own = worst[groups.of_constraint(i)];
        own.impulse = std::max(own.impulse, account.impulse);
        if (!(account.momentum > own.momentum))
          continue;
        own.momentum = account.momentum;
        own.constraint = i;
      }
    for (const Worst &w : worst)
      if (w.impulse > 0. && w.momentum > result.relative_momentum * w.impulse)
      {
        result.momentum = w.momentum;
        result.relative_momentum = w.momentum / w.impulse;
        result.momentum_constraint = w.constraint;
      }
  }

  ContactMeasures::Summary ContactMeasures::summary() const
  {
    Summary result = found;
    find_contact_energy(result);
    find_momentum(result);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const Force &force = forces[i];
      if (force.gap > most_steps_of_motion * force.motion && force.gap > energies.noise(i) &&
          force.motion > 0.)
        result.gap_drifts = true;
      if (!(force.peak > result.resolution * force.mean_peak) || !(force.mean_peak > 0.))
        continue;
      result.resolution = force.peak / force.mean_peak;
      result.resolution_row = i;
      result.peak = force.peak;
      result.mean_peak = force.mean_peak;
      result.mean_time = force.window;
    }
    return result;
  }
} // namespace taut
