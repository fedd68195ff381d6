// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/base/instruction_set.h>
#include <taut/time/contact_measures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Steps between two measurements of the energies that contact energy is compared with: they
    /// cost as much as a tenth of a step.
    constexpr long steps_between_scales = 16;

    /// Motions of a step that a condition on velocities may leave a gap of: one, and the next
    /// one's.
    constexpr double most_steps_of_motion = 2.;

    /// Part of the energy of the reference that rounding gives or takes in a long run at rest.
    constexpr double rounding_of_energy = 1e-8;

    /// The same of a step, and the turn through which moments that are rounding may do work [rad].
    constexpr double rounding_of_step = 1e-14, noise_turn = 1e-2;

    /// Part of the terms of a gap that its carried value may be off by.
    constexpr double rounding_of_gaps = 1e-12;

    /// Scalar product, in partial sums that do not wait for each other.
    double dot(const std::vector<double> &x, const std::vector<double> &y)
    {
      constexpr std::size_t lanes = 16;
      std::array<double, lanes> sums = {};
      vectorised(
          [&sums, a = x.data(), b = y.data(), n = x.size()]
          {
            std::array<double, lanes> s = {};
            for (std::size_t i = 0; i + lanes <= n; i += lanes)
#pragma omp simd
              for (std::size_t l = 0; l < lanes; ++l)
                s[l] += a[i + l] * b[i + l];
            for (std::size_t i = n - n % lanes; i < n; ++i)
              s[i % lanes] += a[i] * b[i];
            sums = s;
          });
      return std::accumulate(sums.begin(), sums.end(), 0.);
    }

    /// Bound of the highest angular frequency at each DoF from the diagonals, 2 sqrt(K_jj / M_jj);
    /// 0 where there is no mass or no stiffness [rad/s].
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
        forces(constraints.size()), multiplier0(start.multiplier), gap0(start.gap)
  {
    const std::vector<double> times = resolved_times();
    constraints.share_of_motions(reference.displacement,
                                 noise = std::vector<double>(constraints.size()),
                                 work = std::vector<double>(constraints.size()));
    structure.communicator().sum(work);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      noise[i] = rounding_of_gaps * (work[i] + std::fabs(constraints[i].gap));
      forces[i].window = times[i];
      forces[i].mean = start.multiplier[i];
      forces[i].impulses.push_back({start.time, 0.});
    }
    bool some_far = false;
    for (std::size_t k = 0; k < structure.size(); ++k)
      some_far = some_far || !structure[k].is_linear();
    moves_far = structure.communicator().any(some_far) || constraints.has_turning();
    measure_rest(start);
    measure_scale(start, Certificate());
  }

  /// What rounding may give at rest: of the strain energy, and of forces in gaps. In bodies that
  /// are not linear each step may give it again.
  void ContactMeasures::measure_rest(const State &start)
  {
    double sums[] = {0., 0.};
    structure.communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < structure.size(); ++k)
          {
            const Substructure &body = structure[k];
            sums[0] += .5 * std::fabs(dot(reference.displacement[k], reference.force[k]));
            if (body.is_linear())
              continue;
            sums[1] += rounding_of_step * body.strain_energy(displacement(reference, start, k)) +
                       noise_turn * body.rounding_of_force(1);
          }
        });
    structure.communicator().sum(sums, 2);
    rest = sums[0];
    rest_of_step = sums[1];
    for (std::size_t i = 0; i < constraints.size(); ++i)
      rest += std::fabs(start.multiplier[i]) * noise[i] / rounding_of_gaps;
    rest *= rounding_of_energy;
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
          if (term.substructure == k && constraints[i].unilateral)
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

  void ContactMeasures::record(const State &state, const StepCoefficients &c,
                               const Certificate &certificate)
  {
    ++n_steps;
    bool is_one_sided = false;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (!constraints[i].unilateral)
        continue;
      is_one_sided = true;
      add_energy(i, state, c);
      add_force(forces[i], state.time, state.last_step, state.multiplier[i]);
      add_gap(i, state, c);
      multiplier0[i] = state.multiplier[i];
      gap0[i] = state.gap[i];
    }
    // Without a unilateral constraint there is no contact that could have given it.
    if (is_one_sided && c.mean_force && !c.velocity_level)
      found.contact_energy += std::max(0., certificate.energy_gain);
    if (moves_far)
      found.motion_energy += std::max(0., certificate.energy_gain);
    if (n_steps < steps_between_scales || n_steps % steps_between_scales == 0)
      measure_scale(state, certificate);
    kinetic = std::max(kinetic, certificate.kinetic_energy);
  }

  template <typename Archive>
  void ContactMeasures::store(Archive &archive)
  {
    for (Force &f : forces)
    {
      archive &f.impulses &f.impulse &f.mean &f.peak &f.mean_peak &f.event_impulse;
      archive &f.largest_impulse &f.event_energy &f.event_begin &f.gap &f.motion;
    }
    archive &multiplier0 &gap0 &noise &worst_event &kinetic &strain &loads &n_steps;
    archive &found.contact_energy &found.motion_energy &found.scale &found.relative_energy &found
        .energy_constraint;
    archive &found.energy_begin &found.energy_end &found.gap &found.gap_constraint;
    archive &found.gap_drifts &found.resolution &found.resolution_row &found.peak;
    archive &found.mean_peak &found.mean_time;
  }

  void ContactMeasures::save(OutputArchive &archive)
  {
    store(archive);
  }

  void ContactMeasures::load(InputArchive &archive)
  {
    store(archive);
  }

  void ContactMeasures::add_energy(const std::size_t i, const State &state,
                                   const StepCoefficients &c)
  {
    Force &force = forces[i];
    const bool is_mean = c.mean_force && state.is_mean[i];
    const double change = state.gap[i] - gap0[i];
    double energy = 0.;
    if (is_mean && !constraints[i].moving && std::isinf(constraints[i].stiffness))
      energy = state.constraint_work[i];
    else if (std::fabs(change) > noise[i])
      energy = is_mean ? state.multiplier[i] * change
                       : .5 * (multiplier0[i] + state.multiplier[i]) * change;
    if (!(c.mean_force && !c.velocity_level))
      found.contact_energy += std::max(0., energy);
    if (!(multiplier0[i] > 0.))
    {
      force.event_energy = 0.;
      force.event_begin = state.time;
    }
    force.event_energy += energy;
    if (force.event_energy > worst_event)
    {
      worst_event = force.event_energy;
      found.energy_constraint = i;
      found.energy_begin = force.event_begin;
      found.energy_end = state.time;
    }
  }

  void ContactMeasures::add_force(Force &force, const double t, const double dt, const double value)
  {
    force.event_impulse = value > 0. ? force.event_impulse + value * dt : 0.;
    force.largest_impulse = std::max(force.largest_impulse, force.event_impulse);
    force.mean = value;
    if (force.window > 0.)
    {
      force.impulse += value * dt;
      force.impulses.push_back({t, force.impulse});
      while (force.impulses.size() > 2 && force.impulses[1].first <= t - force.window)
        force.impulses.pop_front();
    }
    if (force.window > dt)
    {
      const auto &first = force.impulses[0], &second = force.impulses[1];
      const double begin = std::max(first.first, t - force.window),
                   before = first.second + (second.second - first.second) * (begin - first.first) /
                                               (second.first - first.first);
      force.mean = (force.impulse - before) / force.window;
    }
    force.peak = std::max(force.peak, value);
    force.mean_peak = std::max(force.mean_peak, force.mean);
  }

  void ContactMeasures::add_gap(const std::size_t i, const State &state, const StepCoefficients &c)
  {
    if (!std::isinf(constraints[i].stiffness))
      return;
    const double gap = state.multiplier[i] > 0. ? std::fabs(state.gap[i]) : -state.gap[i];
    if (gap > found.gap)
    {
      found.gap = gap;
      found.gap_constraint = i;
    }
    // A condition on velocities leaves a gap of the motion of a step.
    Force &force = forces[i];
    if (c.velocity_level)
      force.motion = std::max(force.motion, state.last_step * std::fabs(state.gap_rate[i]));
    force.gap = std::max(force.gap, gap);
  }

  void ContactMeasures::measure_scale(const State &state, const Certificate &certificate)
  {
    double sums[] = {0., 0., 0.};
    std::vector<double> vector;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      if (certificate.kinetic_energy == 0.)
      {
        vector.assign(body.n_dofs(), 0.);
        body.mass().vmult_add(.5, state.V[k].data(), vector.data());
        sums[0] += dot(vector, state.V[k]);
      }
      sums[1] += .5 * dot(state.U[k], state.KU[k]);
      body.external_force(state.time, vector);
      sums[2] += dot(vector, state.U[k]) - dot(reference.force[k], state.U[k]);
    }
    structure.communicator().sum(sums, 3);
    kinetic = std::max(kinetic, sums[0]);
    strain = std::max(strain, std::fabs(sums[1]));
    loads = std::max(loads, std::fabs(sums[2]));
    constraints.share_of_motions(state.U, vector = std::vector<double>(constraints.size()),
                                 work = std::vector<double>(constraints.size()));
    structure.communicator().sum(work);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      noise[i] = std::max(noise[i], rounding_of_gaps * work[i]);
  }

  ContactMeasures::Summary ContactMeasures::summary() const
  {
    Summary result = found;
    result.scale = kinetic + strain + loads + rest;
    if (result.contact_energy > 0.)
      result.relative_energy = result.contact_energy / result.scale;
    if (const double gain = result.motion_energy - n_steps * rest_of_step; gain > 0.)
      result.relative_motion_energy = gain / result.scale;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const Force &force = forces[i];
      if (force.gap > most_steps_of_motion * force.motion && force.gap > noise[i] &&
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

  std::string ContactMeasures::error() const
  {
    const Summary s = summary();
    std::ostringstream out;
    if (s.relative_energy > wrong_energy)
      out << "unilateral links gave " << s.contact_energy << " J, " << s.relative_energy
          << " of the energy that moves, where they can only take it: most at '"
          << constraints[s.energy_constraint].name << "' between t = " << s.energy_begin << " and "
          << s.energy_end
          << " s. The motion is wrong. Set 'Time/Scheme' to 'automatic', take a smaller step, or "
             "set "
             "'Time/Allow energy gain'";
    else if (s.relative_motion_energy > wrong_energy)
      out << "bodies that move by large amounts gained " << s.motion_energy << " J, "
          << s.relative_motion_energy
          << " of the energy that moves, from nowhere. The motion is wrong. Set 'Time/Scheme' to "
             "'automatic', take a smaller step, or set 'Time/Allow energy gain'";
    return out.str();
  }

  std::string ContactMeasures::error_origin() const
  {
    const Summary s = summary();
    return s.relative_energy > wrong_energy ? constraints.origin(s.energy_constraint) : "";
  }

  std::vector<ContactMeasures::Warning> ContactMeasures::warnings() const
  {
    const Summary s = summary();
    std::vector<Warning> result;
    const auto add = [&](const std::string &kind, const double value, const double limit,
                         const double time, const auto &...parts)
    {
      std::ostringstream message;
      message.precision(3);
      (message << ... << parts);
      result.push_back({kind, message.str(), value, limit, time});
    };
    if (s.relative_energy > suspicious_energy)
      add("contact_energy", s.relative_energy, suspicious_energy, s.energy_end,
          "unilateral links gave ", s.contact_energy, " J, most at '",
          constraints[s.energy_constraint].name, "' between t = ", s.energy_begin, " and ",
          s.energy_end, " s: take 'Scheme = automatic' or a smaller step");
    if (s.relative_motion_energy > suspicious_energy)
      add("motion_energy", s.relative_motion_energy, suspicious_energy, 0.,
          "bodies that move by large amounts gained ", s.motion_energy,
          " J from nowhere: take 'Scheme = automatic' or a smaller step");
    if (s.gap_drifts)
      add("contact_gap", s.gap, 0., 0., "'", constraints[s.gap_constraint].name,
          "' presses across a gap, or penetrates, by more than the motion of a step: take "
          "conditions on gaps");
    if (s.resolution > unresolved)
      add("peak_over_mean", s.resolution, unresolved, 0., "the largest force of '",
          constraints[s.resolution_row].name, "', ", s.peak,
          " N, is an impulse over a step; its largest mean over ", s.mean_time, " s is ",
          s.mean_peak, " N: report that, or the impulse");
    return result;
  }

  std::string ContactMeasures::report() const
  {
    const Summary s = summary();
    std::ostringstream out;
    out.precision(2);
    if (moves_far)
      out << "Large motions: gain of energy " << s.relative_motion_energy << " of the largest\n";
    if (constraints.size() > 0)
      out << "Contacts: energy " << s.relative_energy << " of the largest, gap " << s.gap
          << " m, peak over mean " << s.resolution << '\n';
    for (const Warning &warning : warnings())
      out << "  Warning: " << warning.message << '\n';
    return out.str();
  }
} // namespace taut
