// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/distance_to_range.h"

#include "base/dot.h"
#include "output/motion_record.h"
#include "time/matrix_norms.h"
#include <taut/base/archive.h>
#include <taut/substructure/body_traits.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Part of the displacements of a group below which its motion is rounding, and of the way that
    /// its loads, its impulses or its velocity at the start would make alone: a force that others
    /// balance rounds by this part of itself, and so does a velocity that an impact ends.
    constexpr double rounding_of_places = 1e-9, rounding_of_forces = 1e-15;

    /// Recorded places of all ranks, if bodies have more.
    constexpr std::size_t most_places = 500;

    /// Prescribed DoFs of a group that others may ride on.
    constexpr std::size_t most_bases = 3;

    /// Part of the largest momentum below which impulses are ignored.
    constexpr double least_impulse = 1e-3;

    /// Part of a step by which its end may miss a sample.
    constexpr double rounding_of_times = 1e-6;

    /// The larger number; not-a-number if one is.
    double worse(const double a, const double b)
    {
      return a > b || a != a ? a : b;
    }
  } // namespace

  double MotionDifference::over_bounds() const
  {
    return worse(worse(place / place_bound, impulse / impulse_bound), energy / energy_bound);
  }

  void MotionDifference::scale(const double factor)
  {
    for (double *const difference : {&place, &impulse, &energy})
      *difference *= factor;
  }

  bool MotionDifference::is_place() const
  {
    return !(place / place_bound < over_bounds());
  }

  bool MotionDifference::is_impulse() const
  {
    return !is_place() && !(impulse / impulse_bound < over_bounds());
  }

  MotionRecord::MotionRecord(const Structure &structure, const Constraints &constraints,
                             const ConnectedBodies &groups, const Reference &reference,
                             const State &start, const double interval, const std::size_t n)
      : structure(structure), constraints(constraints), groups(groups), reference(reference),
        begin(start.time), interval(interval), n(n), impulses(structure, constraints, groups, start)
  {
    std::size_t n_all = 0;
    for (const Structure::Body &body : structure.all_bodies())
      n_all += body.n_dofs;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      std::vector<unsigned int> inner; // multipliers of internal constraints
      if (dynamic_cast<const ConstrainedBody *>(&body))
        inner = body.dofs_without_mass();
      std::vector<Place> own;
      for (unsigned int i = 0; i < body.n_dofs(); ++i)
        if ((body.kind(i) == 0 || body.is_lumped()) &&
            std::find(inner.begin(), inner.end(), i) == inner.end())
          own.push_back({k, i, 2 * groups.of_body(k) + body.kind(i), false});
      for (const ConstrainedDof &constraint : body.constraints())
        for (Place &place : own)
          place.is_prescribed = place.is_prescribed || place.dof == constraint.dof;
      const std::size_t first = dofs.size(),
                        stride = body.is_lumped() ? 1 : n_all / most_places + 1;
      for (std::size_t j = 0; j < own.size(); j += stride)
      {
        dofs.push_back(own[j]);
        start_of_dofs.push_back(start.U[k][own[j].dof]);
      }
      if (dofs.size() > first)
        bodies.push_back({k, first, dofs.size(), groups.of_body(k)});
      body.external_force(start.time, work);
      start_load.push_back(reference.force[k]);
      for (std::size_t i = 0; i < work.size(); ++i)
        start_load[k][i] -= work[i];
    }
    places.reserve(n * dofs.size());
    energies.reserve((n + 1) * groups.n_groups());
    add_energies(start, 1., true);
    speed.assign(2 * groups.n_groups(), 0.);
    speed_at_start = speed;
    for (const Place &place : dofs)
    {
      double &fastest = speed_at_start[place.group];
      fastest = std::max(fastest, std::fabs(start.V[place.body][place.dof]));
    }
  }

  void MotionRecord::add_speeds(const State &state)
  {
    for (const auto &[k, first, end, group] : bodies)
      for (std::size_t j = first; j < end; ++j)
      {
        double &fastest = speed[dofs[j].group];
        fastest = std::max(fastest, std::fabs(state.dU[k][dofs[j].dof]) / state.last_step);
      }
  }

  /// Places at a part of the last step.
  void MotionRecord::add_places(const State &state, const double part)
  {
    const double left = 1. - part, h = state.last_step;
    places.resize(places.size() + dofs.size());
    double *const sample = places.data() + n_recorded++ * dofs.size();
    for (const auto &[k, first, end, group] : bodies)
    {
      const double *const U = state.U[k].data(), *const dU = state.dU[k].data(),
                          *const V = state.V[k].data(), *const V_old = state.V_old[k].data();
      for (std::size_t j = first; j < end; ++j)
      {
        const unsigned int i = dofs[j].dof;
        // The Hermite cubic about the end of the step.
        sample[j] = U[i] - start_of_dofs[j] - left * left * (1. + 2. * part) * dU[i] +
                    part * left * h * (left * V_old[i] - part * V[i]);
      }
    }
  }

  /// Of each group of this rank, at the end of the last step or at its start: kinetic energy;
  /// strain energy minus work of the initial loads, plus link springs.
  void MotionRecord::find_energies(const State &state, const bool at_end, Energies &of_groups)
  {
    of_groups.assign(groups.n_groups(), {0., 0.});
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      const std::vector<double> &V = at_end ? state.V[k] : state.V_old[k], &U = state.U[k],
                                &dU = state.dU[k];
      std::array<double, 2> &energy = of_groups[groups.of_body(k)];
      work.assign(body.n_dofs(), 0.);
      body.mass().vmult_add(.5, V.data(), work.data());
      energy[0] += dot_in_lanes(V, work);
      energy[1] += dot_in_lanes(U, start_load[k]);
      if (!at_end)
        energy[1] -= dot_in_lanes(dU, start_load[k]);
      if (!body.is_linear())
      {
        copy_displacement(reference, state, k, work);
        energy[1] -= dot(U, reference.force[k]);
        for (std::size_t i = 0; i < work.size() && !at_end; ++i)
          work[i] -= dU[i];
        energy[1] += body.strain_energy(work) + (at_end ? 0. : dot(dU, reference.force[k]));
        continue;
      }
      energy[1] += .5 * dot_in_lanes(U, state.KU[k]);
      if (at_end)
        continue;
      // 1/2 (U - dU) K (U - dU)
      work.assign(body.n_dofs(), 0.);
      body.stiffness().vmult_add(.5, dU.data(), work.data());
      energy[1] += dot_in_lanes(dU, work) - dot_in_lanes(dU, state.KU[k]);
    }
    for (const std::size_t i : constraints.rows_but_cuts())
      if (!constraints[i].spring.is_rigid() && constraints.is_own(i))
      {
        const RowStates::Spring &spring = state.springs[i];
        of_groups[groups.of_constraint(i)][1] +=
            constraints[i].spring.energy(at_end ? spring.u : spring.u - spring.du);
      }
  }

  /// Energies at a part of the last step, of which they are the first or not.
  void MotionRecord::add_energies(const State &state, const double part, const bool is_first)
  {
    if (is_first)
    {
      find_energies(state, true, now);
      before = now;
      if (part < 1.)
        find_energies(state, false, before);
    }
    for (std::size_t g = 0; g < groups.n_groups(); ++g)
      energies.push_back({before[g][0] + part * (now[g][0] - before[g][0]),
                          before[g][1] + part * (now[g][1] - before[g][1])});
  }

  void MotionRecord::record(const State &state, const StepReport &report)
  {
    impulses.record(state, report);
    add_speeds(state);
    const double early = rounding_of_times * state.last_step;
    for (bool is_first = true; n_recorded < n && time_of(n_recorded) <= state.time + early;
         is_first = false)
    {
      const double until_end = state.time - time_of(n_recorded),
                   part = until_end > early ? 1. - until_end / state.last_step : 1.;
      add_places(state, part);
      add_energies(state, part, is_first);
    }
  }

  /// Largest values over all ranks. Places, impulses and delays by group and kind.
  struct MotionRecord::Sizes
  {
    std::vector<double> place;   ///< 0: rounding
    std::vector<double> impulse; ///< below which impulses are not compared [N s, N m s]
    std::vector<double> late;    ///< shift of an impact that the bound of places allows [s]
    std::vector<double> energy;  ///< by group [J]

    /// Takes those of another run where these are much smaller: this run saw less.
    void add(const Sizes &other)
    {
      const auto raise = [](std::vector<double> &a, const std::vector<double> &b)
      {
        for (std::size_t i = 0; i < a.size(); ++i)
          if (b[i] > much_smaller * a[i])
            a[i] = b[i];
      };
      raise(place, other.place);
      raise(impulse, other.impulse);
      raise(late, other.late);
      raise(energy, other.energy);
    }
  };

  /// The recorded motions of prescribed DoFs that move, base after base and sample by sample, the
  /// same on all ranks. Of each group some DoFs of the first body with one count.
  std::vector<double> MotionRecord::bases(std::vector<std::size_t> &groups_of_bases) const
  {
    const Communicator &all = structure.communicator();
    const std::size_t n_groups = groups.n_groups();
    std::vector<std::vector<std::size_t>> own(n_groups); // places of the first body of this rank
    std::vector<double> first(n_groups, -std::numeric_limits<double>::infinity());
    for (std::size_t j = 0; j < dofs.size(); ++j)
      if (const std::size_t g = dofs[j].group / 2; dofs[j].is_prescribed && dofs[j].group % 2 == 0)
      {
        const double number = -static_cast<double>(structure.number(dofs[j].body));
        if (own[g].empty())
          first[g] = number;
        bool moves = false;
        for (std::size_t s = 0; s < n_samples() && !moves; ++s)
          moves = places[s * dofs.size() + j] != 0.;
        if (moves && first[g] == number && own[g].size() < most_bases)
          own[g].push_back(j);
      }
    groups_of_bases.clear();
    std::vector<double> result;
    for (std::size_t g = 0; g < n_groups; ++g)
    {
      if (own[g].empty())
        first[g] = -std::numeric_limits<double>::infinity();
      const double number = all.max(first[g]);
      if (!std::isfinite(number))
        continue;
      for (std::size_t b = 0; b < most_bases; ++b)
      {
        groups_of_bases.push_back(g);
        for (std::size_t s = 0; s < n_samples(); ++s)
          result.push_back(
              first[g] == number && b < own[g].size() ? places[s * dofs.size() + own[g][b]] : 0.);
      }
    }
    all.sum(result);
    return result;
  }

  /// The largest motion of a place, or that relative to a base of its group if this is less.
  double MotionRecord::own_size(const std::size_t j,
                                const std::vector<std::size_t> &groups_of_bases,
                                const std::vector<double> &motions) const
  {
    const auto largest = [&](const double *base)
    {
      double size = 0.;
      for (std::size_t s = 0; s < n_samples(); ++s)
        size = std::max(size,
                        std::fabs(places[s * dofs.size() + j] - (base == nullptr ? 0. : base[s])));
      return size;
    };
    double result = largest(nullptr);
    for (std::size_t b = 0; b < groups_of_bases.size() && dofs[j].group % 2 == 0; ++b)
      if (groups_of_bases[b] == dofs[j].group / 2)
        result = std::min(result, largest(motions.data() + b * n_samples()));
    return result;
  }

  /// What rounding of balanced loads, and of the forces of constraints, moves each group by in the
  /// time of the record [m].
  std::vector<double> MotionRecord::rounding() const
  {
    const std::size_t n_groups = groups.n_groups();
    std::vector<double> of_groups(2 * n_groups, 0.); // masses and loads
    const std::vector<double> masses = total_masses(structure);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const std::size_t g = groups.of_body(k);
      of_groups[2 * g] += masses[k];
      for (unsigned int i = 0; i < structure[k].n_dofs(); ++i)
        if (structure[k].kind(i) == 0)
          of_groups[2 * g + 1] += std::fabs(start_load[k][i]);
    }
    structure.communicator().sum(of_groups);
    std::vector<double> result;
    const double time = interval * static_cast<double>(n_samples());
    const std::vector<double> sizes = impulses.sizes();
    for (std::size_t g = 0; g < n_groups; ++g)
      result.push_back(of_groups[2 * g] > 0.
                           ? rounding_of_forces * time *
                                 (.5 * time * of_groups[2 * g + 1] + sizes[2 * g]) /
                                 of_groups[2 * g]
                           : 0.);
    return result;
  }

  MotionRecord::Sizes MotionRecord::sizes() const
  {
    const Communicator &all = structure.communicator();
    const std::size_t n_groups = groups.n_groups();
    std::vector<std::size_t> groups_of_bases;
    const std::vector<double> motions = bases(groups_of_bases), forces = rounding();
    std::vector<double> place(2 * n_groups, 0.), whole(2 * n_groups, 0.);
    for (std::size_t j = 0; j < dofs.size(); ++j)
    {
      const auto &[k, i, q, is_prescribed] = dofs[j];
      whole[q] = std::max(whole[q], std::fabs(start_of_dofs[j] + reference.displacement[k][i]));
      if (!is_prescribed)
        place[q] = std::max(place[q], own_size(j, groups_of_bases, motions));
    }
    const Energies of_all = energies_of_all();
    Sizes result;
    for (std::size_t g = 0; g < n_groups; ++g)
    {
      double kinetic = 0., least = of_all[g][1], most = least;
      for (std::size_t e = g; e < of_all.size(); e += n_groups)
      {
        kinetic = std::max(kinetic, of_all[e][0]);
        least = std::min(least, of_all[e][1]);
        most = std::max(most, of_all[e][1]);
      }
      result.energy.push_back(std::max(kinetic, most - least));
      for (std::size_t q = 2 * g; q < 2 * g + 2; ++q)
      {
        const double largest = all.max(place[q]), fastest = all.max(speed[q]),
                     in_free_flight = all.max(speed_at_start[q]) * interval * n_samples(),
                     least_motion = std::max({rounding_of_places * (all.max(whole[q]) + largest),
                                              rounding_of_forces * in_free_flight,
                                              q % 2 == 0 ? forces[g] : 0.});
        result.place.push_back(largest > least_motion ? largest : 0.);
        result.late.push_back(ratio(MotionDifference::place_bound * largest, fastest));
        // 2 T / v of bodies with speeds up to v is at most their momentum.
        result.impulse.push_back(least_impulse * ratio(2. * kinetic, fastest));
      }
    }
    return result;
  }

  /// Sums over all ranks.
  MotionRecord::Energies MotionRecord::energies_of_all() const
  {
    Energies result = energies;
    if (!result.empty())
      structure.communicator().sum(result.front().data(), 2 * result.size());
    return result;
  }

  void MotionRecord::compare_places(const MotionRecord &other, const Sizes &size,
                                    MotionDifference &result) const
  {
    double largest = 0., body = 0., time = 0.;
    for (std::size_t s = 0; s < std::min(n_samples(), other.n_samples()); ++s)
      for (std::size_t j = 0; j < dofs.size(); ++j)
      {
        const double of_group = size.place[dofs[j].group],
                     change = places[s * dofs.size() + j] - other.places[s * dofs.size() + j],
                     d = of_group > 0. ? std::fabs(change) / of_group : 0.;
        if (!(d > largest) && d == d)
          continue;
        largest = d;
        body = static_cast<double>(structure.number(dofs[j].body));
        time = time_of(s);
      }
    const Communicator &all = structure.communicator();
    result.place = all.max(largest);
    const bool is_here = !(largest < result.place);
    result.body = static_cast<std::size_t>(std::max(0., all.max(is_here ? body : -1.)));
    result.time = all.max(is_here ? time : 0.);
  }

  void MotionRecord::compare_energies(const Energies &own, const Energies &others,
                                      const Sizes &size, const double shift,
                                      MotionDifference &result) const
  {
    const std::size_t n_groups = groups.n_groups(),
                      n_both = std::min(own.size(), others.size()) / n_groups;
    const auto change = [=](const Energies &of, const std::size_t s, const std::size_t g)
    {
      const std::array<double, 2> &now = of[s * n_groups + g], &start = of[g];
      return now[0] + now[1] - start[0] - start[1];
    };
    for (std::size_t g = 0; g < n_groups; ++g)
    {
      const double late = shift * std::max(size.late[2 * g], size.late[2 * g + 1]),
                   window = std::max(1., std::floor(late / interval));
      const bool moves = size.place[2 * g] > 0. || size.place[2 * g + 1] > 0.;
      const std::size_t w = static_cast<std::size_t>(std::min<double>(window, n_both));
      for (std::size_t s = 0; s < n_both && moves; ++s)
      {
        const std::size_t first = s > w ? s - w : 0, last = std::min(s + w, n_both - 1);
        const auto of_own = [&](const std::size_t j) { return change(own, j, g); };
        const auto of_others = [&](const std::size_t j) { return change(others, j, g); };
        double off = distance_to_range(of_own(s), first, last, of_others);
        // Near the end an impact that is early here would follow there.
        if (last + 1 == n_both)
          off = std::min(off, distance_to_range(of_others(s), first, s, of_own));
        result.energy = worse(ratio(off, size.energy[g]), result.energy);
      }
    }
  }

  MotionRecord::Differences MotionRecord::differences(const MotionRecord &other,
                                                      const double shift) const
  {
    Sizes size = other.sizes();
    size.add(sizes());
    const Energies own_energies = energies_of_all(), others = other.energies_of_all();
    MotionDifference of_places;
    compare_places(other, size, of_places);
    const auto within = [&](const double part)
    {
      MotionDifference result = of_places;
      const ImpulseRecord::Difference of_impulses = impulses.difference(
          other.impulses, size.impulse, size.late, part, rounding_of_times * interval);
      result.impulse = of_impulses.largest;
      result.name = of_impulses.name;
      result.impulse_at_end = of_impulses.at_end;
      result.name_at_end = of_impulses.name_at_end;
      compare_energies(own_energies, others, size, part, result);
      return result;
    };
    return {within(1.), within(shift)};
  }

  /// Places by number of the body, as a continued run may have bodies on other ranks.
  MotionRecord::PlacesOfBodies MotionRecord::places_of_bodies() const
  {
    PlacesOfBodies result;
    for (std::size_t p = 0; p < places.size(); ++p)
      result[structure.number(dofs[p % dofs.size()].body)].push_back(places[p]);
    return result;
  }

  void MotionRecord::save(OutputArchive &archive)
  {
    const Communicator &all = structure.communicator();
    PlacesOfBodies of_all;
    const PlacesOfBodies own = places_of_bodies();
    for (const std::string &text :
         all.gather(archived([&](OutputArchive &of_rank) { of_rank << own; })))
    {
      PlacesOfBodies of_rank;
      unarchive(text, [&](InputArchive &stored) { stored >> of_rank; });
      of_all.insert(of_rank.begin(), of_rank.end());
    }
    const Energies sums = energies_of_all();
    std::vector<double> fastest;
    for (const double v : speed)
      fastest.push_back(all.max(v));
    archive << n_recorded << of_all << sums << fastest;
    impulses.store(archive);
  }

  void MotionRecord::load(InputArchive &archive)
  {
    PlacesOfBodies of_all;
    archive >> n_recorded >> of_all >> energies >> speed;
    impulses.store(archive);
    places.resize(n_recorded * dofs.size());
    std::map<std::size_t, std::size_t> next; // sample of each body
    for (std::size_t p = 0; p < places.size(); ++p)
    {
      const std::size_t number = structure.number(dofs[p % dofs.size()].body);
      places[p] = of_all[number].at(next[number]++);
    }
    if (!structure.communicator().is_root())
      energies.assign(energies.size(), {0., 0.});
  }
} // namespace taut
