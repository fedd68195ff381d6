// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/stored_row_records.h"
#include <taut/base/sparse_cholesky.h>
#include <taut/time/contact_measures.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace taut
{
  namespace
  {
    /// Motions of a step that a condition on velocities may leave as a gap: of this step and the
    /// next.
    constexpr double most_steps_of_motion = 2.;

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
                                   const EnergyAccount &energy, const State &start)
      : structure(structure), constraints(constraints), energy(energy), forces(constraints.size())
  {
    const std::vector<double> times = resolved_times();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      forces[i].window = times[i];
      forces[i].last = forces[i].mean = start.multiplier[i];
      forces[i].impulses.push_back({start.time, 0.});
    }
  }

  /// 2 / omega_max of the elements under each unilateral constraint; 0: lumped bodies only.
  std::vector<double> ContactMeasures::resolved_times() const
  {
    std::vector<double> highest(constraints.size(), 0.);
    std::vector<std::vector<double>> omega(structure.size());
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const auto &[k, form, of] : constraints[i].terms)
      {
        if (!constraints[i].cone.may_open() || structure[k].is_lumped())
          continue;
        if (omega[k].empty())
          omega[k] = frequencies(structure[k]);
        for (const unsigned int dof : form.index)
          highest[i] = std::max(highest[i], omega[k][dof]);
      }
    // Of all ranks that have a row.
    MatrixEntries of_ranks;
    const Communicator &processes = structure.communicator();
    for (std::size_t i = 0; i < highest.size(); ++i)
      if (highest[i] > 0.)
        of_ranks.add(constraints.number(i), processes.rank(), highest[i]);
    constraints.sum_entries(of_ranks, processes.size());
    for (std::size_t e = 0; e < of_ranks.size(); ++e)
    {
      double &own = highest[constraints.index(of_ranks.row[e])];
      own = std::max(own, of_ranks.value[e]);
    }
    for (double &value : highest)
      value = value > 0. ? 2. / value : 0.;
    return highest;
  }

  void ContactMeasures::record(const State &state, const StepReport &report)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (!constraints[i].cone.may_open())
        continue;
      add_wire_end(i, state);
      add_force(forces[i], state.time, state.last_step, state.multiplier[i]);
      add_gap(i, state, report);
    }
    agree();
  }

  /// Finds the summary of distributed rows, so that it is read without messages.
  void ContactMeasures::agree()
  {
    if (!constraints.shared())
      return;
    agreed = found_now();
    std::vector<std::size_t> named;
    for (const std::size_t number :
         {agreed.energy_constraint, agreed.momentum_constraint, agreed.gap_constraint,
          agreed.drifting_row, agreed.resolution_row})
      if (number != no_link)
        named.push_back(number);
    std::sort(named.begin(), named.end());
    named.erase(std::unique(named.begin(), named.end()), named.end());
    if (named == numbers)
      return;
    numbers = std::move(named);
    labels = constraints.labels(numbers);
  }

  Constraints::Label ContactMeasures::label(const std::size_t number) const
  {
    if (!constraints.shared())
      return number < constraints.size()
                 ? Constraints::Label{constraints[number].name, constraints[number].origin}
                 : Constraints::Label();
    const auto at = std::lower_bound(numbers.begin(), numbers.end(), number);
    return at != numbers.end() && *at == number ? labels[at - numbers.begin()]
                                                : Constraints::Label();
  }

  void ContactMeasures::add_wire_end(const std::size_t i, const State &state)
  {
    Force &f = forces[i];
    if (f.last <= f.end.force || !(constraints.distance_beyond(i, state.time) > 0.))
      return;
    const State::Spring &spring = state.springs[i];
    f.end = {state.time, f.last, constraints[i].spring.energy(spring.u - spring.du)};
  }

  template <typename Archive>
  void ContactMeasures::store(Archive &archive)
  {
    for (Force &force : forces)
      forget_past(force);
    store_of_rows(archive, constraints, forces);
    std::vector<double> gap = {largest_gap};
    std::vector<std::size_t> row = {gap_row};
    constraints.take_largest(gap, row);
    archive &gap.front() & row.front();
    largest_gap = gap.front();
    gap_row = constraints.index(row.front());
  }

  void ContactMeasures::save(OutputArchive &archive)
  {
    store(archive);
  }

  void ContactMeasures::load(InputArchive &archive)
  {
    store(archive);
    agree();
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

  void ContactMeasures::add_gap(const std::size_t i, const State &state, const StepReport &report)
  {
    if (!constraints[i].spring.is_rigid())
      return;
    const double gap = state.multiplier[i] > 0. ? std::fabs(state.complementarity_gap[i])
                                                : -state.complementarity_gap[i];
    if (gap > largest_gap)
    {
      largest_gap = gap;
      gap_row = i;
    }
    // A condition on velocities leaves a gap of about the motion of a step.
    Force &force = forces[i];
    if (report.method.rules[i].is_on_velocity())
      force.motion = std::max(force.motion, state.last_step * std::fabs(state.rate[i]));
    force.gap = std::max(force.gap, gap);
  }

  ContactMeasures::Summary ContactMeasures::found_now() const
  {
    Summary result;
    static_cast<EnergySummary &>(result) = energy.summary();
    // The largest gap, that above the motion of a step, and the largest resolution.
    largest = {largest_gap, 0., 1.};
    number = {gap_row, no_link, no_link};
    const auto raise = [&](const std::size_t of, const double value, const std::size_t i)
    {
      if (!(value > largest[of]))
        return;
      largest[of] = value;
      number[of] = i;
    };
    for (const std::size_t i : constraints.rows_but_cuts())
    {
      const Force &force = forces[i];
      if (force.gap > most_steps_of_motion * force.motion && force.gap > energy.noise(i) &&
          force.motion > 0.)
        raise(1, force.gap, i);
      if (force.mean_peak > 0.)
        raise(2, force.peak / force.mean_peak, i);
    }
    constraints.take_largest(largest, number);
    result.gap = largest[0];
    result.gap_constraint = number[0];
    result.drifting_gap = largest[1];
    result.drifting_row = number[1];
    result.resolution = largest[2];
    result.resolution_row = number[2];
    of_rows.assign(4, 0.);
    const auto is_counted = [&](const std::size_t i)
    { return i < forces.size() && constraints.counts(i); };
    if (const std::size_t i = constraints.index(number[1]); is_counted(i))
      of_rows[0] = constraints[i].rotational;
    if (const std::size_t i = constraints.index(number[2]); is_counted(i))
      std::tie(of_rows[1], of_rows[2], of_rows[3]) =
          std::tuple(forces[i].peak, forces[i].mean_peak, forces[i].window);
    constraints.add_up(of_rows);
    result.drift_is_rotation = of_rows[0] != 0.;
    result.peak = of_rows[1];
    result.mean_peak = of_rows[2];
    result.mean_time = of_rows[3];
    return result;
  }
} // namespace taut
