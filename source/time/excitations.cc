// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/excitations.h"
#include <taut/base/exceptions.h>
#include <taut/interface/geometry.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Prescribed DoFs of a body that are looked at: those of a face move alike, or by one formula.
    constexpr std::size_t most_dofs = 4;

    /// Samples of a run and of a step, at least.
    constexpr long samples_of_run = 20000, samples_of_step = 8;

    /// Longer runs are not searched.
    constexpr long most_steps = 10'000'000;

    /// Steps whose areas are compared, and the parts of areas and of the range that may be lost.
    constexpr std::size_t window = 10;
    constexpr double lost_area = .1, lost_range = .1;

    /// What the steps lose of one excitation.
    class Losses
    {
    public:
      Losses(const Excitation &excitation, const double start, const double step,
             const long n_steps)
          : excitation(excitation), start(start), step(step),
            n_samples(std::max(samples_of_step, samples_of_run / n_steps + 1))
      {
        try
        {
          at_start = excitation.at(start);
          for (long m = 0; m < n_steps; ++m)
            add_step(m);
        }
        catch (const UserError &)
        {
          // The run says so if it comes to a time without a value.
        }
      }

      /// The feature, or none if all is seen.
      UnseenFeature feature() const
      {
        const bool loses_area = largest_loss > lost_area * largest_area,
                   loses_range = !excitation.is_load && excursion > lost_range * (most - least);
        if (!loses_area && !loses_range)
          return {};
        const long m = loses_range ? step_of_excursion : step_of_loss;
        return {excitation.name, excitation.origin, start + (m + .5) * step, width_in(m)};
      }

    private:
      double value(const long m, const long k) const
      {
        return excitation.at(start + (m + static_cast<double>(k) / n_samples) * step) - at_start;
      }

      void add_step(const long m)
      {
        double area = 0., size = 0., before = last, low = last, high = last;
        for (long k = 1; k <= n_samples; ++k)
        {
          const double now = value(m, k);
          area += .5 * (before + now) / n_samples;
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
        const double loss = std::fabs(area - .5 * (last + before));
        last = before;
        std::array<double, 2> &oldest = of_steps[m % window];
        if (loss > largest_of_step)
        {
          largest_of_step = loss;
          step_of_loss = m;
        }
        oldest = {loss, size};
        double losses = 0., sizes = 0.;
        for (const auto &[of_step, size_of_step] : of_steps)
        {
          losses += of_step;
          sizes += size_of_step;
        }
        largest_loss = std::max(largest_loss, losses);
        largest_area = std::max(largest_area, sizes);
      }

      /// Width of a block of the height and area of what the values at the ends of a step and its
      /// neighbours do not make, or that of the parts of an oscillation.
      double width_in(const long m) const
      {
        const long n = std::max(n_samples, samples_of_run / 10);
        double area = 0., height = 0., before = 0.;
        int n_turns = 0;
        const double first = excitation.at(start + m * step),
                     end = excitation.at(start + (m + 1.) * step);
        for (long k = 0; k <= n; ++k)
        {
          const double part = static_cast<double>(k) / n,
                       off =
                           excitation.at(start + (m + part) * step) - first - part * (end - first);
          area += std::fabs(off) / n;
          height = std::max(height, std::fabs(off));
          n_turns += off * before < 0.;
          before = off == 0. ? before : off;
        }
        return height > 0. ? area / height * step / (1 + n_turns) : step;
      }

      const Excitation &excitation;
      const double start, step;
      const long n_samples; ///< of a step
      double at_start = 0., last = 0.;
      double least = 0., most = 0., excursion = 0.;
      double largest_loss = 0., largest_area = 0., largest_of_step = 0.;
      long step_of_excursion = 0, step_of_loss = 0;
      std::array<std::array<double, 2>, window> of_steps =
          {}; ///< losses and areas of the last ones
    };
  } // namespace

  namespace
  {
    /// The sum of the forces, each with a weight of its own: opposite ones do not cancel.
    double weighted_sum(const TimeLoad &load, const double t, std::vector<double> &P)
    {
      constexpr double golden = 0.61803398874989485;
      std::fill(P.begin(), P.end(), 0.);
      load.add(t, P);
      double sum = 0., weight = 1.;
      for (const double force : P)
      {
        sum += weight * force;
        weight = weight > 1. ? weight - golden : weight + 1. - golden;
      }
      return sum;
    }

    Excitation of_load(const Substructure &body, const std::shared_ptr<const TimeLoad> &load)
    {
      Excitation result{"the load on '" + body.name() + "'", body.origin(), true, false,
                        [load](const double t) { return load->sample(t); }};
      try
      {
        result.is_costly = std::isnan(load->sample(0.));
      }
      catch (const UserError &)
      {
        // It has no value at the start, which the run says when it gets there.
      }
      if (result.is_costly)
        result.at = [load, P = std::vector<double>(body.n_dofs())](const double t) mutable
        { return weighted_sum(*load, t, P); };
      return result;
    }
  } // namespace

  std::vector<Excitation> excitations(const Structure &structure, const Constraints &constraints)
  {
    std::vector<Excitation> all;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      for (const auto &load : body.loads_in_time())
        all.push_back(of_load(body, load));
      std::vector<const ConstrainedDof *> moving;
      for (const ConstrainedDof &constraint : body.constraints())
        if (constraint.motion)
          moving.push_back(&constraint);
      const std::size_t stride = moving.size() / most_dofs + 1;
      for (std::size_t i = 0; i < moving.size(); i += stride)
        all.push_back({"the prescribed place of '" + body.name() + "'", body.origin(), false, false,
                       moving[i]->motion});
    }
    for (const std::size_t i : constraints.sliding_rows())
      if (const auto *place = dynamic_cast<const MovingPlace *>(constraints[i].geometry.get()))
        all.push_back({"the height under '" + constraints[i].name + "'", constraints.origin(i),
                       false, false, [place](const double t) { return place->profile(t); }});
    return all;
  }

  UnseenFeature find_unseen_feature(const std::vector<Excitation> &all,
                                    const Communicator &processes, const double start,
                                    const double step, const long n_steps)
  {
    UnseenFeature narrowest;
    if (n_steps < 1 || n_steps > most_steps)
      return narrowest;
    for (const Excitation &excitation : all)
    {
      if (excitation.is_costly)
        continue;
      UnseenFeature own = Losses(excitation, start, step, n_steps).feature();
      if (!own.name.empty() && own.width < narrowest.width)
        narrowest = std::move(own);
    }
    // The narrowest of all ranks.
    const double least = -processes.max(-narrowest.width);
    if (!std::isfinite(least))
      return narrowest;
    const bool is_own = narrowest.width == least;
    narrowest.width = least;
    narrowest.time = processes.max(is_own ? narrowest.time : -1.);
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
