// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/time/contact_measures.h>

#include <algorithm>
#include <cmath>

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
    std::vector<double> common;
    for (const std::size_t i : constraints.common_rows())
      common.push_back(highest[i]);
    structure.communicator().max(common);
    for (const std::size_t i : constraints.common_rows())
      highest[i] = common[i - *constraints.common_rows().begin()];
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
    for (const std::size_t i : constraints.common_rows())
    {
      Force &f = forces[i];
      forget_past(f);
      archive &f.impulses &f.impulse &f.mean &f.peak &f.mean_peak &f.event_impulse;
      archive &f.largest_impulse &f.gap &f.motion &f.last &f.end;
    }
    const std::size_t n = constraints.n_of_all();
    std::size_t number = found.gap > 0. ? constraints.number(found.gap_constraint) : n;
    archive &found.gap &number;
    found.gap_constraint = number < n ? constraints.index(number) : no_link;
  }

  void ContactMeasures::save(OutputArchive &archive)
  {
    store(archive);
  }

  void ContactMeasures::load(InputArchive &archive)
  {
    store(archive);
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
    if (gap > found.gap)
    {
      found.gap = gap;
      found.gap_constraint = i;
    }
    // A condition on velocities leaves a gap of about the motion of a step.
    Force &force = forces[i];
    if (report.method.rules[i].is_on_velocity())
      force.motion = std::max(force.motion, state.last_step * std::fabs(state.rate[i]));
    force.gap = std::max(force.gap, gap);
  }

  ContactMeasures::Summary ContactMeasures::summary() const
  {
    Summary result = found;
    static_cast<EnergySummary &>(result) = energy.summary();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const Force &force = forces[i];
      if (force.gap > most_steps_of_motion * force.motion && force.gap > energy.noise(i) &&
          force.motion > 0. &&
          (result.drifting_row == no_link || force.gap > forces[result.drifting_row].gap))
        result.drifting_row = i;
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
