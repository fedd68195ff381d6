// SPDX-License-Identifier: LGPL-2.1-or-later
#include "reference.h"

#include "common.h"
#include "event_driven.h"
#include "verification/run.h"

#include <boost/numeric/odeint.hpp>
#include <utility>

namespace hunt
{
  using verification::largest;
  using verification::largest_difference;

  namespace
  {
    /// Of the second reference: a disturbance of the start, and shorter steps.
    constexpr double disturbance = 1e-9, finer = 1.37;
    constexpr double sure = .25; ///< part of a bound by which references may differ
    /// Impulses below this part of the largest momentum are nothing.
    constexpr double least_impulse = 1e-3;
    /// Steps of the references by the program in one of the run.
    constexpr std::size_t coarse = 16, fine = 32;
    constexpr int n_behind = 16; ///< samples behind the end of the run

    double ratio(const double a, const double b)
    {
      return a == 0. ? 0. : a / b;
    }

    /// The speed is that of a place between two samples.
    struct Largest
    {
      double place = 0., impulse = 0., energy = 0., speed = 0.;
    };

    Largest largest_values(const History &history)
    {
      Largest result;
      double least = history[0].potential, most = least;
      for (std::size_t k = 0; k < history.size(); ++k)
      {
        const Sample &sample = history[k], &before = history[k > 0 ? k - 1 : 0];
        result.place = std::max(result.place, largest_difference(sample.place, history[0].place));
        if (k > 0)
          result.speed = std::max(result.speed, largest_difference(sample.place, before.place) /
                                                    (sample.time - before.time));
        result.impulse = std::max(result.impulse, largest(sample.impulse));
        result.energy = std::max(result.energy, sample.kinetic);
        least = std::min(least, sample.potential);
        most = std::max(most, sample.potential);
      }
      // 2 T / v of bodies with speeds up to v is at most their momentum.
      result.impulse =
          std::max(result.impulse, least_impulse * ratio(2. * result.energy, result.speed));
      result.energy = std::max(result.energy, most - least);
      return result;
    }

    /// The range of what the samples of a window have.
    class Range
    {
    public:
      Range(const History &history, const std::size_t k, const double time)
      {
        first = k > 0 ? k - 1 : 0;
        last = std::min(k + 1, history.size() - 1);
        while (first > 0 && history[k].time - history[first].time < time)
          --first;
        while (last + 1 < history.size() && history[last].time - history[k].time < time)
          ++last;
      }

      /// How far @p x is from what @p value is of the samples.
      template <typename Value>
      double distance(const double x, const Value &value) const
      {
        double least = value(first), most = least;
        for (std::size_t k = first + 1; k <= last && (x < least || x > most); ++k)
        {
          least = std::min(least, value(k));
          most = std::max(most, value(k));
        }
        // Not-a-number stays one.
        return x >= least && x <= most ? 0. : std::max(x - most, least - x);
      }

    private:
      std::size_t first, last;
    };

    /// The larger one; not-a-number if one is.
    double worse(const double a, const double b)
    {
      return a > b || a != a ? a : b;
    }
  } // namespace

  void join_repeated(const LinearModel &model, History &history)
  {
    const std::vector<LinearModel::Row> &rows = model.rows;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (rows[i].unilateral && rows[j].unilateral && rows[i].rigid() && rows[j].rigid() &&
            rows[i].gap == rows[j].gap && rows[i].terms == rows[j].terms)
          for (Sample &sample : history)
            sample.impulse[j] += std::exchange(sample.impulse[i], 0.);
  }

  Difference difference(const History &reference, const History &run)
  {
    const Largest size = largest_values(reference);
    const double late = ratio(place_bound * size.place, size.speed);
    Difference result;
    for (std::size_t k = 0; k < std::min(run.size(), reference.size()); ++k)
    {
      const Range range(reference, k, late);
      result.place = worse(largest_difference(reference[k].place, run[k].place), result.place);
      for (std::size_t i = 0; i < run[k].impulse.size(); ++i)
        result.impulse = worse(range.distance(run[k].impulse[i], [&](const std::size_t j)
                                              { return reference[j].impulse[i]; }),
                               result.impulse);
      result.energy =
          worse(range.distance(run[k].energy() - run[0].energy(), [&](const std::size_t j)
                               { return reference[j].energy() - reference[0].energy(); }),
                result.energy);
    }
    return {ratio(result.place, size.place), ratio(result.impulse, size.impulse),
            ratio(result.energy, size.energy)};
  }

  void Recorder::operator()(const taut::StepView &view)
  {
    const std::size_t m = view.constraints.size();
    if (!model)
    {
      model = std::make_unique<LinearModel>(view, frequency, pulse);
      impulse.assign(m, 0.);
      multiplier = view.state.multiplier;
    }
    else
      for (std::size_t i = 0; i < m; ++i)
      {
        const double N = view.state.multiplier[i];
        impulse[i] +=
            (view.report.is_mean(i) ? N : .5 * (N + multiplier[i])) * view.state.last_step;
        multiplier[i] = N;
      }
    const Vector u = model->displacement(view);
    Sample sample = {view.state.time, model->places(u), impulse,
                     model->kinetic(model->velocity(view)), model->potential(u)};
    for (std::size_t i = 0; i < m; ++i)
      if (!view.constraints[i].spring.is_rigid())
        sample.potential += view.constraints[i].spring.energy(view.state.springs[i].u);
    history.push_back(sample);
  }

  namespace
  {
    History swing(const Pendulum &p, const std::vector<double> &times, const double tolerance,
                  const double disturbance)
    {
      using State = std::array<double, 5>; // x, y, their rates, impulse of the rope
      const auto force = [&](const State &s)
      { return p.stiffness * std::max(0., std::hypot(s[0], s[1]) - p.length); };
      const auto rates = [&](const State &s, State &rate, const double)
      {
        const double N = force(s), r = std::hypot(s[0], s[1]);
        rate = {s[2], s[3], -N * s[0] / (r * p.mass), -N * s[1] / (r * p.mass) - p.gravity, N};
      };
      State state = {p.start[0] * (1. + disturbance), p.start[1], p.start[2], p.start[3], 0.};
      History history;
      const auto observe = [&](const State &s, const double t)
      {
        const double stretch = force(s) / p.stiffness;
        history.push_back({t,
                           {s[0] - p.start[0], s[1] - p.start[1]},
                           {s[4]},
                           .5 * p.mass * (s[2] * s[2] + s[3] * s[3]),
                           p.mass * p.gravity * s[1] + .5 * p.stiffness * stretch * stretch});
      };
      namespace odeint = boost::numeric::odeint;
      odeint::integrate_times(odeint::make_controlled(tolerance * p.length, tolerance,
                                                      odeint::runge_kutta_dopri5<State>()),
                              rates, state, times.begin(), times.end(), times.back() / 1e4,
                              observe);
      return history;
    }

    /// The sample between two others.
    Sample between(const Sample &a, const Sample &b, const double time)
    {
      const double part = b.time > a.time ? (time - a.time) / (b.time - a.time) : 1.;
      const auto mix = [&](const double x, const double y) { return x + part * (y - x); };
      Sample result = {time, a.place, a.impulse, mix(a.kinetic, b.kinetic),
                       mix(a.potential, b.potential)};
      for (std::size_t i = 0; i < a.place.size(); ++i)
        result.place[i] = mix(a.place[i], b.place[i]);
      for (std::size_t i = 0; i < a.impulse.size(); ++i)
        result.impulse[i] = mix(a.impulse[i], b.impulse[i]);
      return result;
    }

    /// The program with a part of the step, by a scheme that 'automatic' did not take, at these
    /// times as far as it comes. Contacts may divide its steps, and those of the run.
    History other_scheme(const HuntScene &scene, const std::size_t parts,
                         const std::vector<double> &times, const std::string &chosen)
    {
      const bool took_alpha = chosen.find("(automatic): generalised-alpha") != std::string::npos;
      verification::Session session(
          scene.text,
          {std::string("Time.Scheme=") + (took_alpha ? "Newmark" : "BDF2"),
           "Time.Mass redistribution=no", "Time.Allow unsuitable scheme=true",
           "Time.Allow energy gain=true", "Time.Step=" + verification::number(scene.step / parts),
           "Time.End=" + verification::number(times.back())});
      Recorder recorder(scene.frequency);
      session.run(std::ref(recorder));
      const History &found = recorder.history;
      History result;
      std::size_t k = 1;
      for (const double time : times)
      {
        while (k + 1 < found.size() && found[k].time < time)
          ++k;
        if (time <= found[k].time * (1. + 1e-9))
          result.push_back(between(found[k - 1], found[k], time));
      }
      return result;
    }
  } // namespace

  Reference make_reference(const HuntScene &scene, const LinearModel *model,
                           std::vector<double> times, const std::string &chosen)
  {
    Reference result;
    const double end = times.back(), behind = std::max(scene.step, place_bound * end);
    for (int i = 1; i <= n_behind; ++i)
      times.push_back(end + behind * i / n_behind);
    try
    {
      History other;
      if (scene.kind == ReferenceKind::event_driven)
      {
        result.history = event_driven_history(*model, scene.restitution, scene.reach, times);
        other =
            event_driven_history(*model, scene.restitution, scene.reach, times, finer, disturbance);
      }
      else if (scene.kind == ReferenceKind::pendulum)
      {
        result.history = swing(scene.pendulum, times, 1e-10, 0.);
        other = swing(scene.pendulum, times, 1e-9, disturbance);
      }
      else
      {
        result.history = other_scheme(scene, fine, times, chosen);
        other = other_scheme(scene, coarse, times, chosen);
      }
      const Difference d = difference(result.history, other);
      result.has_places = d.place < sure * place_bound;
      result.has_sums = d.impulse < sure * impulse_bound && d.energy < sure * energy_bound;
      if (!result.has_sums)
        result.missing = "two references differ";
    }
    catch (const std::exception &e)
    {
      result.missing = e.what();
      result.has_sums = result.has_places = false;
    }
    return result;
  }
} // namespace hunt
