// SPDX-License-Identifier: LGPL-2.1-or-later
#include "event_driven.h"

namespace hunt
{
  namespace
  {
    /// Part of the largest speed below which an approach has no rebound, which ends their row.
    constexpr double least_approach = 1e-5;
    /// Rounding of speeds and accelerations, and of gaps that touch, relative to their terms.
    constexpr double rounding_of_impulses = 1e-10, rounding_of_touch = 1e-9;
  } // namespace

  /// Impulses @p p that end the approach of the rows of the @p set of those that touch, and of all
  /// bilateral ones; true if none pulls and no other row approaches.
  bool EventDriven::impulses(const std::vector<std::size_t> &touching, const unsigned int set,
                             const double e, Vector &p)
  {
    const std::size_t n = parts.n_q();
    std::vector<std::size_t> active;
    for (std::size_t r = 0; r < modes.size(); ++r)
      if (!model.rows[r].unilateral && model.rows[r].rigid())
        active.push_back(r);
    for (std::size_t k = 0; k < touching.size(); ++k)
      if (set >> k & 1U)
        active.push_back(touching[k]);
    const auto rate = [&](const std::size_t r)
    {
      double sum = 0.;
      for (std::size_t j = 0; j < n; ++j)
        sum += parts.B(j, r) * state[n + j];
      return sum;
    };
    const auto wanted = [&](const std::size_t r)
    {
      const double before = rate(r);
      const bool rebounds = model.rows[r].unilateral && before < -least_approach * speed;
      return rebounds ? -e * before : 0.;
    };
    const auto product = [&](const std::size_t a, const std::size_t b)
    {
      double sum = 0.;
      for (std::size_t j = 0; j < n; ++j)
        sum += parts.B(j, a) * parts.B(j, b);
      return sum;
    };
    p.assign(modes.size(), 0.);
    if (!active.empty())
    {
      dealii::FullMatrix<double> G(active.size(), active.size());
      for (std::size_t a = 0; a < active.size(); ++a)
        for (std::size_t b = 0; b < active.size(); ++b)
          G(a, b) = product(active[a], active[b]);
      G.gauss_jordan();
      for (std::size_t a = 0; a < active.size(); ++a)
        for (std::size_t b = 0; b < active.size(); ++b)
          p[active[a]] += G(a, b) * (wanted(active[b]) - rate(active[b]));
    }
    for (const std::size_t r : touching)
    {
      double after = rate(r);
      for (const std::size_t a : active)
        after += product(r, a) * p[a];
      const double tolerance = rounding_of_impulses * speed * std::sqrt(product(r, r));
      if (!(p[r] >= -tolerance / product(r, r)) || !(after >= wanted(r) - tolerance))
        return false;
    }
    return true;
  }

  /// All rigid rows that touch at this moment.
  void EventDriven::impact()
  {
    const std::size_t n = parts.n_q();
    for (std::size_t j = 0; j < n; ++j)
      speed = std::max(speed, std::fabs(state[n + j]));
    std::vector<std::size_t> touching;
    for (std::size_t r = 0; r < modes.size(); ++r)
      if (model.rows[r].unilateral && model.rows[r].rigid() && parts.acts_on_mass[r])
      {
        const Vector gap = phase().gap(r);
        if (modes[r] > 0 || dot(gap, state) <= rounding_of_touch * size_of(gap, state))
          touching.push_back(r);
      }
    Vector p;
    unsigned int set = 0;
    const unsigned int n_sets = 1U << touching.size();
    while (set < n_sets && !impulses(touching, set, restitution, p))
      ++set;
    if (set == n_sets)
      throw NoReference("no impulses satisfy the law of impact");
    for (std::size_t r = 0; r < modes.size(); ++r)
    {
      state[2 * n + r] += p[r];
      for (std::size_t j = 0; j < n; ++j)
        state[n + j] += parts.B(j, r) * p[r];
    }
    choose_closed(touching);
  }

  /// Of the rows that touch, those that stay closed: forces push, and the others do not approach.
  void EventDriven::choose_closed(const std::vector<std::size_t> &touching)
  {
    std::vector<std::size_t> resting;
    for (const std::size_t r : touching)
    {
      modes[r] = 0;
      double rate = 0., size = 0.;
      for (std::size_t j = 0; j < parts.n_q(); ++j)
      {
        rate += parts.B(j, r) * state[parts.n_q() + j];
        size += std::fabs(parts.B(j, r));
      }
      if (rate <= rounding_of_touch * size * speed)
        resting.push_back(r);
    }
    for (unsigned int set = 0; set < 1U << resting.size(); ++set)
    {
      for (std::size_t k = 0; k < resting.size(); ++k)
        modes[resting[k]] = set >> k & 1U;
      const Phase &trial = phase();
      bool fits = true;
      for (const std::size_t r : resting)
      {
        double acceleration = 0., size = 0.;
        for (std::size_t j = 0; j < parts.n_q(); ++j)
        {
          const double a = dot(trial.acceleration()[j], state);
          acceleration += parts.B(j, r) * a;
          size += std::fabs(parts.B(j, r) * a);
        }
        const double force = dot(trial.force(r), state);
        fits = fits && (modes[r] > 0 ? force >= 0. : acceleration >= -rounding_of_touch * size);
      }
      if (fits)
        return;
    }
    throw NoReference("no forces keep the touching rows together");
  }
} // namespace hunt
