// SPDX-License-Identifier: LGPL-2.1-or-later

#include "time/turning_at_rest.h"
#include "time/matrix_norms.h"
#include "time/static_step.h"
#include <taut/base/exceptions.h>
#include <taut/substructure/body_traits.h>
#include <taut/substructure/local_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Part of the loads that stands in for N even where directions do not change any more: it
    /// holds what nothing else does, and costs no iterations.
    constexpr double least_part = 1e-8;

    /// Part of the length of a link below which the ends of a segment meet: no link with a force
    /// rests there, see TurningDirection::vanishes().
    constexpr double least_distance = 1e-6;

    /// Of each segment of a link: one along it, then two across it.
    constexpr std::size_t n_springs = 3;

    /// A pivot below this part of the stiffness of its spring is not positive: a single prop counts
    /// as unstable from 2e-6 below its critical load on.
    constexpr double least_pivot = 1e-6;
  } // namespace

  TurningAtRest::TurningAtRest(const Structure &structure, const Constraints &constraints,
                               const double load)
      : all(constraints), undeformed(structure.zero()), load(load > 0. ? load : 1.)
  {
  }

  void TurningAtRest::begin(const BodyVectors &U)
  {
    if (empty())
      return;
    turned = 1.;
    set(U, std::vector<double>(all.size(), 0.));
  }

  void TurningAtRest::go_on(const StaticState &state)
  {
    if (!empty())
      set(state.displacement, state.multiplier);
  }

  void TurningAtRest::set(const BodyVectors &U, const std::vector<double> &N, const bool is_check)
  {
    std::vector<ConstraintData> list;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      list.push_back(all[i]);
      list.back().geometry = nullptr;
    }
    const std::vector<Coordinates> motions = all.differences(U);
    directions.clear();
    source.clear();
    for (const std::size_t i : all.turning_rows())
    {
      const TurningDirection &turning = all.turning(i);
      const Coordinates *const moved = motions.data() + *all.segments(i).begin();
      const TurningDirection::Linear at = turning.linearised(moved);
      list[i].terms = at.terms;
      list[i].gap = at.gap;
      list[i].gap_size = 0.;
      for (std::size_t k = 0; k < turning.size(); ++k)
      {
        directions.push_back(at.directions[k]);
        // Gaps, and motions across, round with the places of the ends. A ring may come to rest
        // where a segment is much shorter than before, and N / |Delta| across it decides where.
        const double distance = std::max(at.distances[k], least_distance * turning.length),
                     size = std::max(distance, turning.length_of(k)),
                     stand_in = load * std::clamp(turned, least_part, 1.) / size,
                     geometric = (is_check ? std::fabs(N[i]) : std::max(0., -turning.sign * N[i])) /
                                 distance;
        list[i].gap_size += size;
        const auto add_spring = [&](const Coordinates &direction, const double stiffness)
        {
          list.push_back(geometric_spring(all[i].name, all[i], k, direction, stiffness, moved[k]));
          list.back().gap_size = size;
        };
        add_spring(at.directions[k], stand_in);
        for (const Coordinates &direction : across(at.directions[k]))
          add_spring(direction, geometric + stand_in);
        source.insert(source.end(), n_springs, i);
      }
    }
    linear = std::make_unique<Constraints>(all, std::move(list));
  }

  double TurningAtRest::largest_length() const
  {
    double largest = 0.;
    for (const std::size_t i : all.turning_rows())
      largest = std::max(largest, all.turning(i).length);
    return largest;
  }

  double TurningAtRest::change(const StaticState &state)
  {
    const std::vector<Coordinates> motions = all.differences(state.displacement);
    double result = 0.;
    turned = 0.;
    for (const std::size_t i : all.turning_rows())
    {
      const TurningDirection &turning = all.turning(i);
      std::vector<Coordinates> differences;
      double change = 0., size = 0.;
      for (const std::size_t j : all.segments(i))
      {
        const std::size_t k = differences.size();
        differences.push_back(add_scaled(turning.start[k], 1., motions[j]));
        change = std::max(norm(turning.at(k, differences[k]) - directions[j]), change);
        size += std::max(norm(differences[k]), turning.length_of(k));
      }
      const double gap = turning.gap(differences.data());
      turned = std::max(turned, change);
      if (all[i].cone.rests_open(state.multiplier[i], gap))
        continue;
      const double miss = std::fabs(gap - state.distance[i]) / size;
      result = std::max({result, change, miss});
      if (std::isnan(change) || std::isnan(miss))
        return std::numeric_limits<double>::infinity();
    }
    return result;
  }

  void TurningAtRest::finish(StaticState &state) const
  {
    if (empty())
      return;
    for (std::vector<double> *v : {&state.multiplier, &state.complementarity_gap, &state.distance})
      v->resize(all.size());
    if (std::size_t &worst = state.residuals.worst_constraint;
        worst >= all.n_of_all() && worst != no_link)
      worst = all.number(source[worst - all.n_of_all()]);
  }

  std::vector<double> TurningAtRest::gaps(const BodyVectors &U) const
  {
    std::vector<double> result = all.motions(U);
    for (std::size_t i = 0; i < all.size(); ++i)
      result[i] += all[i].gap;
    const std::vector<Coordinates> ends = all.differences(undeformed, U);
    for (const std::size_t i : all.turning_rows())
      result[i] = all.turning(i).gap(ends.data() + *all.segments(i).begin());
    return result;
  }

  std::vector<TurningAtRest::Across> TurningAtRest::begin_check(const StaticState &state)
  {
    std::vector<Across> springs;
    const std::vector<double> &N = state.multiplier;
    const std::vector<Coordinates> motions = all.differences(state.displacement);
    for (const std::size_t i : all.turning_rows())
    {
      const TurningDirection &turning = all.turning(i);
      const std::size_t first = *all.segments(i).begin();
      for (std::size_t k = 0; k < turning.size() && turning.sign * N[i] > 0.; ++k)
      {
        const double stiffness = N[i] / norm(add_scaled(turning.start[k], 1., motions[first + k]));
        for (std::size_t spring = 1; spring < n_springs; ++spring)
          springs.push_back({all.size() + n_springs * (first + k) + spring, std::fabs(stiffness)});
      }
    }
    turned = 0.;
    if (!springs.empty())
      set(state.displacement, N, true);
    return springs;
  }

  std::size_t TurningAtRest::first_that_gives_way(StaticStep &step,
                                                  const std::vector<Across> &springs)
  {
    const std::size_t n = springs.size();
    std::vector<std::size_t> rows;
    for (const Across &spring : springs)
      rows.push_back(spring.row);
    std::vector<std::vector<double>> L;
    if (!step.flexibility(rows, L))
      return n;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j)
      {
        double sum = (i == j ? 1. : 0.) -
                     2. * std::sqrt(springs[i].stiffness * springs[j].stiffness) * L[i][j];
        for (std::size_t k = 0; k < j; ++k)
          sum -= L[i][k] * L[j][k];
        if (i == j && !(sum > least_pivot))
          return i;
        L[i][j] = i == j ? std::sqrt(sum) : sum / L[j][j];
      }
    return n;
  }

  namespace
  {
    /// Part of the largest stiffness over mass below which a tangent that is not definite is
    /// definite but for rounding: of a cable with a compression of about as small a part of its
    /// axial stiffness.
    constexpr double indifferent = 1e-8;

    bool is_indifferent(const Substructure &body, const std::vector<double> &U)
    {
      const double mass = largest_on_diagonal(body.mass());
      if (dynamic_cast<const SlenderBody *>(&body) == nullptr || !(mass > 0.))
        return false;
      const std::unique_ptr<SymmetricMatrix> K = body.tangent(U, {}, 0., false);
      try
      {
        make_local_solver("block tridiagonal", *K)
            ->factor({{1., K.get()}, {indifferent * largest_on_diagonal(*K) / mass, &body.mass()}},
                     body.constrained_dofs());
      }
      catch (const BodyNotHeld &)
      {
        return false;
      }
      return true;
    }
  } // namespace

  bool are_indifferent(const Structure &structure, const BodyVectors &U)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (!structure[k].is_linear() && !is_indifferent(structure[k], U[k]))
        return false;
    return true;
  }

  bool are_in_tension(const Structure &structure, const BodyVectors &U)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const auto *const slender = dynamic_cast<const SlenderBody *>(&structure[k]);
      if (!structure[k].is_linear() && !(slender && slender->is_in_tension(U[k])))
        return false;
    }
    return true;
  }
} // namespace taut
