// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/unseen_feature.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace taut
{
  namespace
  {
    /// Samples of a run and of a step, at least: what is narrower than the distance of the samples
    /// may be missed.
    constexpr long samples_of_run = 20000, samples_of_step = 8;

    /// Samples of all excitations together, about some seconds; a step has two at least.
    constexpr long most_samples = 40'000'000;

    /// Samples in each of some steps, of so many excitations.
    long samples_in_step(const long n_steps, const long n_excitations)
    {
      const long wanted = std::max(samples_of_step, samples_of_run / n_steps + 1);
      return std::max(2L, std::min(wanted, most_samples / n_steps / n_excitations));
    }

    /// Places at which a load in space is looked at if a few do not show a feature, at least and at
    /// most, and the evaluations of all such loads together, about half a second.
    constexpr std::size_t fewest_places = 8, most_places = 256;
    constexpr double most_evaluations = 4e6;

    /// Part of what the places show that all forces have to show, both relative to their sizes, and
    /// number of forces in all samples up to which these alone are looked at, about a second.
    constexpr double least_shown = .3, most_forces = 5e7;

    /// Longer runs are not searched: two samples a step are 2e7 for one excitation, half of
    /// most_samples.
    constexpr long most_steps = 10'000'000;

    /// Steps whose areas are compared, and the parts of areas and of the range that may be lost. A
    /// jump loses at most half a step of 40, 1.25 %, and a sine of 13 steps a period 2 % of its
    /// area; with 5 steps a period it exceeds its values at their ends by a tenth of its range.
    constexpr std::size_t window = 40;
    constexpr double lost_area = .02, lost_range = .1;

    /// The same of one pulse inside of a step: it exceeds both ends by this multiple of how much
    /// the ends around it bend, of which a smooth curve exceeds them by an eighth and a kink by a
    /// half. Between what steps show it is a surprise, and may alone close a contact.
    constexpr double pulse_over_bend = 4., area_of_pulse = .005, range_of_pulse = .02;

    /// Steps on both sides of a feature, of the run and at most of the shorter ones, and halvings,
    /// in the search of a step that sees it.
    constexpr double around = 2., most_around = 64.;

    /// Steps in the width of a feature beyond which shorter ones see no more: a jump at each end
    /// loses a step of 2 %, which is lost_area, with fifty of them.
    constexpr double most_in_feature = 500.;
    constexpr int most_halvings = 16;

    /// What the steps lose of one excitation.
    class Losses
    {
    public:
      /// @p at_rest is the value in balance at the start of the run. If @p first_by_end, the first
      /// step takes the value at its end for the whole step.
      Losses(const Excitation &excitation, const double at_rest, const bool first_by_end,
             const double start, const double step, const long n_steps, const long n_samples)
          : excitation(excitation), at_start(at_rest), start(start), step(step), n_steps(n_steps),
            n_samples(n_samples), first_by_end(first_by_end)
      {
        last = excitation.at(start) - at_start;
        least = most = last;
        for (long m = 0; m < n_steps; ++m)
          add_step(m);
        take_pulse(n_steps - 1, 0.);
      }

      bool sees_all() const
      {
        return !loses_area() && !loses_start() && !loses_range() && !loses_pulse();
      }

      /// Where most is lost: a width and a time.
      std::pair<double, double> narrowest() const
      {
        return width_and_time(loses_range()   ? step_of_excursion
                              : loses_area()  ? step_of_loss
                              : loses_start() ? 0
                                              : step_of_pulse);
      }

    private:
      bool loses_area() const { return largest_loss > lost_area * largest_area; }
      bool loses_start() const { return loss_of_first > lost_area * largest_area; }
      bool loses_range() const
      {
        return !excitation.is_load && excursion > lost_range * (most - least);
      }

      bool loses_pulse() const
      {
        return excitation.is_load ? pulse > area_of_pulse * largest_area
                                  : pulse > range_of_pulse * (most - least);
      }

      /// Looks at a step once it is known how much the ends bend behind it.
      void take_pulse(const long m, const double bend)
      {
        const double size = excitation.is_load ? last_loss : last_outside;
        if (last_outside > pulse_over_bend * std::max(last_bend, bend) && size > pulse)
        {
          pulse = size;
          step_of_pulse = m;
        }
        last_bend = bend;
      }

      double value(const long m, const long k) const
      {
        return excitation.at(start + (m + static_cast<double>(k) / n_samples) * step) - at_start;
      }

      void add_step(const long m)
      {
        double area = 0., moment = 0., size = 0., before = last, low = last, high = last;
        for (long k = 1; k <= n_samples; ++k)
        {
          const double now = value(m, k), mean = .5 * (before + now) / n_samples;
          area += mean;
          moment +=
              mean * ((k - .5) / n_samples - .5) + (now - before) / (12. * n_samples * n_samples);
          size += .5 * (std::fabs(before) + std::fabs(now)) / n_samples;
          before = now;
          low = std::min(low, now);
          high = std::max(high, now);
        }
        const double outside =
            std::max(high - std::max(last, before), std::min(last, before) - low);
        if (outside > excursion)
        {
          excursion = outside;
          step_of_excursion = m;
        }
        least = std::min(least, low);
        most = std::max(most, high);
        if (m > 0)
          take_pulse(m - 1, std::fabs(end_before - 2. * last + before));
        end_before = last;
        const bool is_first = m == 0 && first_by_end;
        if (is_first)
          last = before;
        // Opposite pulses in a step leave a change of the place, as a pulse of the size of their
        // moment over half of a step.
        const double loss = std::max(std::fabs(area - .5 * (last + before)),
                                     2. * std::fabs(moment - (before - last) / 12.));
        last = before;
        last_loss = loss;
        last_outside = outside;
        if (is_first)
          loss_of_first = loss;
        else if (loss > largest_of_step)
        {
          largest_of_step = loss;
          step_of_loss = m;
        }
        std::array<double, 2> &oldest = of_steps[m % window];
        const double shared = is_first ? 0. : loss;
        losses += shared - oldest[0];
        sizes += size - oldest[1];
        oldest = {shared, size};
        largest_loss = std::max(largest_loss, losses);
        largest_area = std::max(largest_area, sizes);
      }

      /// Width of a block of the height and area of what a step and its neighbours have beyond the
      /// line between their ends, or that of the parts of an oscillation; and the time of the
      /// largest such value.
      std::pair<double, double> width_and_time(const long m) const
      {
        const long n = 3 * std::max(n_samples, samples_of_run / 10);
        const double begin = start + std::max(0L, m - 1) * step,
                     end = start + std::min(m + 2, n_steps) * step, length = end - begin,
                     first = excitation.at(begin), last_value = excitation.at(end);
        constexpr double rounding = 1e-12;
        double area = 0., height = 0., before = 0., time = begin;
        int n_turns = 0;
        for (long k = 0; k <= n; ++k)
        {
          const double part = static_cast<double>(k) / n,
                       now = excitation.at(begin + part * length);
          double off = now - first - part * (last_value - first);
          if (std::fabs(off) <=
              rounding * std::max({std::fabs(now), std::fabs(first), std::fabs(last_value)}))
            off = 0.;
          area += std::fabs(off) / n;
          n_turns += off * before < 0.;
          before = off == 0. ? before : off;
          if (std::fabs(off) <= height)
            continue;
          height = std::fabs(off);
          time = begin + part * length;
        }
        return {height > 0. ? area / height * length / (1 + n_turns) : step, time};
      }

      const Excitation &excitation;
      const double at_start, start, step;
      const long n_steps, n_samples; ///< of the run, and of a step
      const bool first_by_end;
      double last = 0.;
      double least = 0., most = 0., excursion = 0.;
      double losses = 0., sizes = 0.; ///< in the last steps
      double largest_loss = 0., largest_area = 0., largest_of_step = 0.;
      long step_of_excursion = 0, step_of_loss = 0;
      double loss_of_first = 0.; ///< if it is by its end
      double end_before = 0., last_loss = 0., last_outside = 0., last_bend = 0., pulse = 0.;
      long step_of_pulse = 0;
      std::array<std::array<double, 2>, window> of_steps =
          {}; ///< losses and areas of the last ones
    };

    UnseenFeature look_for(const Excitation &excitation, const LoadsAtStart loads,
                           const double start, const double step, const long n_steps,
                           const long n_samples)
    {
      const bool is_balanced = !excitation.is_load || loads == LoadsAtStart::balanced,
                 first_by_end = excitation.is_load && loads == LoadsAtStart::unseen;
      const double at_rest = is_balanced ? excitation.at(start) : 0.;
      const Losses losses(excitation, at_rest, first_by_end, start, step, n_steps, n_samples);
      if (losses.sees_all())
        return {};
      UnseenFeature result{excitation.name, excitation.origin};
      std::tie(result.width, result.time) = losses.narrowest();
      // Steps that get shorter, about the feature, which is an end of some of them.
      constexpr double phase = .38;
      const auto looked_at = [&](const double length_of_step)
      {
        const double beside = std::min(around * step, result.width + most_around * length_of_step);
        return std::pair(std::max(start, result.time - beside),
                         std::min(result.time + beside, start + n_steps * step));
      };
      const auto see_all = [&](const double length_of_step, const double offset)
      {
        constexpr double rounding = 1e-6; // of a number of steps
        const auto [first, end] = looked_at(length_of_step);
        const auto whole = static_cast<long>((end - first) / length_of_step + rounding);
        const long n = std::max(1L, whole - (offset > 0.));
        const double in_feature = std::ceil(samples_of_step * length_of_step / result.width);
        return Losses(excitation, at_rest, first_by_end && first == start,
                      first + offset * length_of_step, length_of_step, n,
                      static_cast<long>(
                          std::clamp<double>(in_feature, samples_of_step, samples_in_step(n, 1))))
            .sees_all();
      };
      result.longest_step = step;
      for (int k = 0; k < most_halvings && most_in_feature * result.longest_step > result.width;
           ++k)
      {
        result.longest_step *= .5;
        if (see_all(result.longest_step, 0.) &&
            (looked_at(result.longest_step).first == start || see_all(result.longest_step, phase)))
          break;
      }
      return result;
    }

    /// How far a value is at the time of a feature from the mean of those that are its width
    /// earlier and later, over the largest of the three.
    template <typename Value>
    double bump(const UnseenFeature &feature, const double start, const double end,
                const Value &value)
    {
      const double a = value(std::max(start, feature.time - feature.width)),
                   b = value(std::min(feature.time + feature.width, end)),
                   now = value(feature.time), off = std::fabs(now - .5 * (a + b));
      return off > 0. ? off / std::max({std::fabs(a), std::fabs(b), std::fabs(now)}) : 0.;
    }

    UnseenFeature nothing(const bool is_complete)
    {
      UnseenFeature result;
      result.is_complete = is_complete;
      return result;
    }

    /// Looks at a load in space in places that @p seen has, and returns what all forces show, too.
    /// Where they do not, they are looked at alone, if this is cheap.
    UnseenFeature look_in_space(const Excitation &excitation, const Excitation &seen,
                                const LoadsAtStart loads, const double start, const double step,
                                const long n_steps, const long n_samples)
    {
      const double end = start + static_cast<double>(n_steps) * step;
      UnseenFeature result = look_for(seen, loads, start, step, n_steps, n_samples);
      if (result.name.empty())
        return result;
      try
      {
        const double wanted = least_shown * bump(result, start, end, seen.at);
        for (const bool of_sizes : {false, true})
        {
          const double shown =
              bump(result, start, end,
                   [&](const double t) { return excitation.of_all_forces(t, of_sizes); });
          if (shown >= wanted)
            return result;
        }
      }
      catch (const UserError &)
      {
        return result; // the load is so narrow that it cannot be integrated
      }
      const double n_forces = static_cast<double>(n_steps) * static_cast<double>(n_samples) *
                              static_cast<double>(excitation.n_dofs);
      if (n_forces > most_forces)
        return nothing(false);
      Excitation as_a_whole = excitation;
      as_a_whole.at = [&](const double t) { return excitation.of_all_forces(t, false); };
      return look_for(as_a_whole, loads, start, step, n_steps, n_samples);
    }

    /// What many places show of a load in space, and few do not.
    UnseenFeature look_closely(const Excitation &excitation, const std::size_t n_places,
                               const LoadsAtStart loads, const double start, const double step,
                               const long n_steps, const long n_samples)
    {
      const double end = start + static_cast<double>(n_steps) * step;
      Excitation closely = excitation;
      closely.at = [&](const double t) { return excitation.at_places(t, n_places); };
      UnseenFeature result =
          look_in_space(excitation, closely, loads, start, step, n_steps, n_samples);
      if (result.name.empty() || bump(result, start, end, excitation.at) >=
                                     least_shown * bump(result, start, end, closely.at))
        return nothing(result.is_complete);
      result.is_local = true;
      return result;
    }
  } // namespace

  UnseenFeature find_unseen_feature(const std::vector<Excitation> &all,
                                    const Communicator &processes, const LoadsAtStart loads,
                                    const double start, const double step, const long n_steps,
                                    const Places places)
  {
    if (n_steps < 1 || n_steps > most_steps)
      return nothing(false);
    UnseenFeature narrowest;
    bool is_complete = true;
    const long n_samples = samples_in_step(n_steps, static_cast<long>(all.size()) + 1);
    double n_in_space = 0.;
    for (const Excitation &excitation : all)
      n_in_space += excitation.at_places != nullptr;
    const auto n_places = static_cast<std::size_t>(
        std::min<double>(most_places, most_evaluations / static_cast<double>(n_steps) /
                                          static_cast<double>(n_samples) / n_in_space));
    for (const Excitation &excitation : all)
      if (!excitation.is_costly)
        try
        {
          if (places == Places::many && !excitation.at_places)
            continue;
          if (places == Places::many && n_places <= fewest_places)
          {
            is_complete = false;
            continue;
          }
          const UnseenFeature own =
              places == Places::many
                  ? look_closely(excitation, n_places, loads, start, step, n_steps, n_samples)
              : excitation.at_places
                  ? look_in_space(excitation, excitation, loads, start, step, n_steps, n_samples)
                  : look_for(excitation, loads, start, step, n_steps, n_samples);
          is_complete = is_complete && own.is_complete;
          if (!std::isfinite(own.width))
            continue;
          const double seeing = std::min(own.longest_step, narrowest.longest_step);
          if (own.width < narrowest.width)
            narrowest = own;
          narrowest.longest_step = seeing;
        }
        catch (const UserError &)
        {
          is_complete = false;
          // The run says so if it comes to a time without a value.
        }
    narrowest.is_complete = !processes.any(!is_complete);
    // The narrowest of all ranks.
    const double least = -processes.max(-narrowest.width);
    if (!std::isfinite(least))
      return narrowest;
    const bool is_own = narrowest.width == least;
    narrowest.width = least;
    narrowest.time = processes.max(is_own ? narrowest.time : -1.);
    narrowest.is_local = processes.any(is_own && narrowest.is_local);
    narrowest.longest_step = -processes.max(-narrowest.longest_step);
    for (std::string *const text : {&narrowest.name, &narrowest.origin})
    {
      const std::vector<std::string> of_ranks = processes.gather(is_own ? *text : "");
      const auto found = std::find_if(of_ranks.begin(), of_ranks.end(),
                                      [](const std::string &t) { return !t.empty(); });
      *text = found == of_ranks.end() ? "" : *found;
    }
    return narrowest;
  }
} // namespace taut
