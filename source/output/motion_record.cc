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
#include <tuple>

namespace taut
{
  namespace
  {
    /// Part of the displacements of a group below which its motion is rounding.
    constexpr double rounding_of_places = 1e-9;

    /// Part of the largest momentum below which impulses are ignored.
    constexpr double least_impulse = 1e-3;

    /// Part of the tolerated shift of an impact that two runs may differ by; the rest is for the
    /// error of the better run.
    constexpr double part_of_lateness = .5;

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
        begin(start.time), interval(interval), n(n), impulses(start)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      std::vector<unsigned int> inner; // multipliers of internal constraints
      if (dynamic_cast<const ConstrainedBody *>(&body))
        inner = body.dofs_without_mass();
      const std::size_t first = dofs.size();
      for (unsigned int i = 0; i < body.n_dofs(); ++i)
        if (body.kind(i) == 0 && std::find(inner.begin(), inner.end(), i) == inner.end())
        {
          dofs.push_back({k, i, groups.of_body(k)});
          start_of_dofs.push_back(start.U[k][i]);
        }
      if (dofs.size() > first)
        bodies.push_back({k, first, dofs.size(), !inner.empty()});
      body.external_force(start.time, work);
      start_load.push_back(reference.force[k]);
      for (std::size_t i = 0; i < work.size(); ++i)
        start_load[k][i] -= work[i];
    }
    places.reserve(n * dofs.size());
    energies.reserve((n + 1) * groups.n_groups());
    add_energies(start);
    speed.assign(groups.n_groups(), 0.);
  }

  void MotionRecord::add_speeds(const State &state)
  {
    for (const auto &[k, first, end, has_inner] : bodies)
    {
      const std::vector<double> &dU = state.dU[k];
      double motion = 0.;
      if (has_inner)
        for (std::size_t j = first; j < end; ++j)
          motion = std::max(motion, std::fabs(dU[dofs[j].dof]));
      else
        motion = max_norms(structure[k], dU)[0];
      double &fastest = speed[dofs[first].group];
      fastest = std::max(fastest, motion / state.last_step);
    }
  }

  /// Places at a part of the last step.
  void MotionRecord::add_places(const State &state, const double part)
  {
    const double left = 1. - part, h = state.last_step;
    places.resize(places.size() + dofs.size());
    double *const sample = places.data() + n_recorded++ * dofs.size();
    for (const auto &[k, first, end, has_inner] : bodies)
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

  /// Kinetic energy; strain energy minus work of the initial loads, plus link springs.
  void MotionRecord::add_energies(const State &state)
  {
    energies.resize(energies.size() + groups.n_groups(), {0., 0.});
    const auto result = energies.end() - static_cast<std::ptrdiff_t>(groups.n_groups());
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      std::array<double, 2> &energy = result[groups.of_body(k)];
      work.assign(body.n_dofs(), 0.);
      body.mass().vmult_add(.5, state.V[k].data(), work.data());
      energy[0] += dot_in_lanes(state.V[k], work);
      energy[1] += dot_in_lanes(state.U[k], start_load[k]);
      if (body.is_linear())
        energy[1] += .5 * dot_in_lanes(state.U[k], state.KU[k]);
      else
      {
        copy_displacement(reference, state, k, work);
        energy[1] += body.strain_energy(work) - dot(state.U[k], reference.force[k]);
      }
    }
    if (structure.communicator().is_root())
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if (!constraints[i].spring.is_rigid())
          result[groups.of_constraint(i)][1] += constraints[i].spring.energy(state.springs[i].u);
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
      if (is_first)
        add_energies(state);
      else
        for (std::size_t g = 0; g < groups.n_groups(); ++g)
          energies.push_back(energies[energies.size() - groups.n_groups()]);
    }
  }

  /// Largest values of the groups over all ranks.
  struct MotionRecord::Sizes
  {
    std::vector<double> place, energy;
    std::vector<double> impulse; ///< below which impulses are not compared [N s]
    std::vector<double> late;    ///< tolerated shift of an impact [s]
    Energies energies;           ///< over all ranks
  };

  MotionRecord::Sizes MotionRecord::sizes() const
  {
    const std::size_t n_groups = groups.n_groups();
    std::vector<double> place(n_groups, 0.), whole(n_groups, 0.), kinetic(n_groups, 0.);
    for (std::size_t s = 0; s < n_samples(); ++s)
      for (std::size_t j = 0; j < dofs.size(); ++j)
      {
        const auto &[k, i, g] = dofs[j];
        const double u = places[s * dofs.size() + j];
        place[g] = std::max(place[g], std::fabs(u));
        whole[g] =
            std::max(whole[g], std::fabs(u + start_of_dofs[j] + reference.displacement[k][i]));
      }
    Sizes result;
    result.impulse.assign(n_groups, 0.);
    result.energies = energies;
    for (std::array<double, 2> &energy : result.energies)
      structure.communicator().sum(energy.data(), 2);
    for (std::size_t g = 0; g < n_groups; ++g)
    {
      const Communicator &all = structure.communicator();
      const double largest = all.max(place[g]), fastest = all.max(speed[g]);
      result.place.push_back(largest > rounding_of_places * all.max(whole[g]) ? largest : 0.);
      double least = result.energies[g][1], most = least;
      for (std::size_t e = g; e < result.energies.size(); e += n_groups)
      {
        kinetic[g] = std::max(kinetic[g], result.energies[e][0]);
        least = std::min(least, result.energies[e][1]);
        most = std::max(most, result.energies[e][1]);
      }
      result.energy.push_back(std::max(kinetic[g], most - least));
      result.late.push_back(
          ratio(part_of_lateness * MotionDifference::place_bound * largest, fastest));
      // 2 T / v of bodies with speeds up to v is at most their momentum.
      result.impulse[g] = least_impulse * ratio(2. * kinetic[g], fastest);
    }
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

  void MotionRecord::compare_energies(const Sizes &other, MotionDifference &result) const
  {
    const Sizes own = sizes();
    const std::size_t n_groups = groups.n_groups(),
                      n_both = std::min(own.energies.size(), other.energies.size()) / n_groups;
    const auto change = [=](const Sizes &of, const std::size_t s, const std::size_t g)
    {
      const std::array<double, 2> &now = of.energies[s * n_groups + g], &start = of.energies[g];
      return now[0] + now[1] - start[0] - start[1];
    };
    for (std::size_t g = 0; g < n_groups; ++g)
    {
      const double window = std::max(1., std::floor(other.late[g] / interval));
      const std::size_t w = static_cast<std::size_t>(std::min<double>(window, n_both));
      for (std::size_t s = 0; s < n_both && other.place[g] > 0.; ++s)
        result.energy =
            worse(ratio(distance_to_range(change(own, s, g), s > w ? s - w : 0,
                                          std::min(s + w, n_both - 1),
                                          [&](const std::size_t j) { return change(other, j, g); }),
                        other.energy[g]),
                  result.energy);
    }
  }

  MotionDifference MotionRecord::difference(const MotionRecord &other) const
  {
    const Sizes size = other.sizes();
    MotionDifference result;
    compare_places(other, size, result);
    std::tie(result.impulse, result.row) = impulses.difference(
        other.impulses, groups, size.impulse, size.late, rounding_of_times * interval);
    compare_energies(size, result);
    return result;
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
    Energies sums = energies;
    for (std::array<double, 2> &energy : sums)
      all.sum(energy.data(), 2);
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
