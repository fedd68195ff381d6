// SPDX-License-Identifier: LGPL-2.1-or-later
#include "event_driven.h"

#include <boost/math/tools/toms748_solve.hpp>

namespace hunt
{
  namespace
  {
    constexpr double least_looks = 4000.; ///< events are looked for at least so often in a motion
    /// Multiplications, about two seconds, and events of one motion.
    constexpr double most_work = 4e9;
    constexpr unsigned int most_events = 20000, most_events_at_once = 60;
    /// Rounding of gaps and forces, relative to the terms that they are summed from.
    constexpr double rounding_part = 1e-13;
    /// Halvings of a step down to the shortest rebound that is looked for.
    constexpr int shortest_rebound = 30;
    /// Steps are rounded to so many binary digits: those of one length then share a matrix.
    constexpr int digits_of_a_step = 30;

    double rounded(const double step)
    {
      int exponent = 0;
      const double digits = std::frexp(step, &exponent);
      return std::ldexp(std::round(std::ldexp(digits, digits_of_a_step)),
                        exponent - digits_of_a_step);
    }
  } // namespace

  double size_of(const Vector &a, const Vector &b)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += std::fabs(a[i] * b[i]);
    return sum;
  }

  EventDriven::EventDriven(const LinearModel &model, const double restitution, const double reach,
                           const double duration, const double fineness, const double disturbance)
      : model(model), parts(model, reach), restitution(restitution),
        largest_step(duration / least_looks), fineness(fineness), modes(model.rows.size(), 0),
        state(parts.n_state(), 0.), opened(model.rows.size(), 0.), set(model.rows.size(), 0.)
  {
    if (model.has_moving)
      throw NoReference("a constraint moves or turns");
    set_start(disturbance);
  }

  void EventDriven::set_start(const double disturbance)
  {
    const std::size_t n = parts.n_q();
    dealii::FullMatrix<double> inverse(n, n);
    inverse.invert(parts.T);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
      {
        state[j] += inverse(j, i) * model.start[parts.with_mass[i]] * (1. + disturbance);
        state[n + j] += inverse(j, i) * model.start_velocity[parts.with_mass[i]] *
                        (1. + disturbance * (i % 2 ? -1. : 1.));
      }
    state[parts.one()] = state[parts.one() + 1] = 1.;
    std::vector<std::size_t> touching;
    for (std::size_t r = 0; r < modes.size(); ++r)
    {
      const LinearModel::Row &row = model.rows[r];
      if (!row.unilateral)
      {
        modes[r] = 1;
        continue;
      }
      const double D = row.gap + dot(row.terms, model.start);
      const bool touches = D <= 1e-9 * (std::fabs(row.gap) + size_of(row.terms, model.start));
      if (row.rigid() && touches)
        touching.push_back(r);
      else if (!row.rigid() && D < 0.)
      {
        const Vector &u = parts.springs[r].u;
        modes[r] = static_cast<int>(std::upper_bound(u.begin(), u.end(), -D) - u.begin());
      }
    }
    if (!touching.empty())
      impact();
  }

  const Phase &EventDriven::phase()
  {
    return phases.try_emplace(modes, parts, modes).first->second;
  }

  double EventDriven::relaxed(const std::size_t row, const double t) const
  {
    const LinearModel::Row &data = model.rows[row];
    return set[row] == 0. ? 0.
                          : set[row] * std::exp(-data.stiffness / data.damping * (t - opened[row]));
  }

  const std::vector<EventDriven::Watched> &EventDriven::watched()
  {
    const auto found = watches.find(modes);
    if (found != watches.end())
      return found->second;
    const Phase &current = phase();
    std::vector<Watched> result;
    for (std::size_t r = 0; r < modes.size(); ++r)
    {
      if (!model.rows[r].unilateral)
        continue;
      if (modes[r] == 0)
      {
        result.push_back({r, 1, current.gap(r), true});
        continue;
      }
      const Pieces &spring = parts.springs[r];
      const std::size_t piece = modes[r] - 1, one = parts.one();
      Vector deeper = current.gap(r), less = deeper;
      for (double &x : less)
        x = -x;
      less[one] -= piece > 0 ? spring.u[piece] : 0.;
      result.push_back({r, -1, piece == 0 ? current.force(r) : less, false});
      if (piece + 1 < spring.u.size())
      {
        deeper[one] += spring.u[piece + 1];
        result.push_back({r, 1, deeper, false});
      }
    }
    return watches.emplace(modes, result).first->second;
  }

  double EventDriven::value(const Watched &event, const Vector &z, const double t) const
  {
    return dot(event.value, z) + (event.relaxes ? relaxed(event.row, t) : 0.);
  }

  double EventDriven::rounding(const Watched &event, const Vector &z) const
  {
    return rounding_part * size_of(event.value, z);
  }

  double EventDriven::root(const Watched &event, const double step, const double at_end)
  {
    Phase &current = phases.at(modes);
    const auto function = [&](const double x)
    { return value(event, current.propagate(state, x), time + x); };
    // A value that is zero but for rounding may rise before it falls: a short rebound.
    double begin = 0., at_begin = value(event, state, time);
    for (int k = 1; at_begin <= rounding(event, state) && k <= shortest_rebound; ++k)
    {
      begin = std::ldexp(step, -k);
      at_begin = function(begin);
    }
    if (at_begin <= 0.)
      return 0.;
    std::uintmax_t iterations = 60;
    return boost::math::tools::toms748_solve(function, begin, step, at_begin, at_end,
                                             boost::math::tools::eps_tolerance<double>(48),
                                             iterations)
        .second;
  }

  void EventDriven::spend(const double more)
  {
    work += more;
    if (work > most_work)
      throw NoReference("more work than it is worth");
  }

  /// True if something changed within the step; the state is then that of its moment.
  bool EventDriven::find_event(const Vector &next, const double step)
  {
    const Watched *first = nullptr;
    double at = step;
    for (const Watched &event : watched())
      if (const double v = value(event, next, time + step); v < -rounding(event, next))
        if (const double x = root(event, step, v); !first || x < at)
        {
          first = &event;
          at = x;
        }
    if (!first)
      return false;
    state = phases.at(modes).propagate(state, at);
    time += at;
    n_at_once = at > 1e-9 * step ? 0 : n_at_once + 1;
    if (++n_events > most_events || n_at_once > most_events_at_once)
      throw NoReference("events without end");
    const Watched event = *first;
    change(event);
    return true;
  }

  void EventDriven::change(const Watched &event)
  {
    const std::size_t r = event.row;
    const LinearModel::Row &row = model.rows[r];
    if (row.rigid() && event.change > 0 && parts.acts_on_mass[r])
    {
      modes[r] = 0;
      impact();
      return;
    }
    if (modes[r] == 1 && event.change < 0 && row.damping > 0. && !row.rigid())
    {
      opened[r] = time;
      set[r] = std::max(0., -dot(phase().gap(r), state));
    }
    modes[r] += event.change;
  }

  void EventDriven::advance(const double end)
  {
    const Pulse &pulse = model.pulse;
    for (; pulse.width > 0. && n_kinks < 3; ++n_kinks)
    {
      const double kink = pulse.begin + .5 * n_kinks * pulse.width;
      if (kink > end)
        break;
      move(kink);
      state[parts.pulse()] = n_kinks == 1 ? 1. : 0.;
      state[parts.pulse() + 1] = n_kinks == 2 ? 0. : pulse.rise() * (n_kinks == 1 ? -1. : 1.);
    }
    move(end);
  }

  /// To a time up to which the pulse has no kink.
  void EventDriven::move(const double end)
  {
    while (end - time > 1e-8 * (end - time + largest_step) && end > time)
    {
      phase();
      Phase &current = phases.at(modes);
      const double longest = std::min(current.step(), largest_step) / fineness,
                   remaining = end - time,
                   step = rounded(remaining / std::ceil(remaining / longest));
      const Vector next = current.propagate(state, step);
      spend(static_cast<double>(state.size()) * state.size());
      if (!std::isfinite(next[0]))
        throw NoReference("a number that is not finite");
      if (!find_event(next, step))
      {
        state = next;
        time += step;
      }
    }
  }

  Sample EventDriven::sample()
  {
    const Phase &current = phase();
    const std::size_t n = parts.n_q();
    Sample result;
    result.time = time;
    const Vector u = current.displacement(state);
    result.place = model.places(u);
    result.impulse.assign(state.begin() + 2 * n, state.begin() + 2 * n + modes.size());
    for (std::size_t j = 0; j < n; ++j)
      result.kinetic += .5 * state[n + j] * state[n + j];
    result.potential = model.potential(u);
    for (std::size_t r = 0; r < modes.size(); ++r)
    {
      const LinearModel::Row &row = model.rows[r];
      if (row.rigid())
        continue;
      const double d = modes[r] > 0 ? -dot(current.gap(r), state) : relaxed(r, time);
      result.potential += row.law ? row.law->energy(d) : .5 * row.stiffness * d * d;
    }
    return result;
  }

  History event_driven_history(const LinearModel &model, const double restitution,
                               const double reach, const std::vector<double> &times,
                               const double fineness, const double disturbance)
  {
    EventDriven motion(model, restitution, reach, times.back(), fineness, disturbance);
    History result;
    for (const double t : times)
    {
      motion.advance(t);
      result.push_back(motion.sample());
      result.back().time = t;
    }
    return result;
  }
} // namespace hunt
