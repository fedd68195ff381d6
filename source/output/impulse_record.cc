// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/distance_to_range.h"

#include "base/gather_entries.h"
#include "output/impulse_record.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace taut
{
  namespace
  {
    /// Ends of steps with impulses, fewest and most, and numbers at these ends; of more steps every
    /// second one is kept, or fourth, and so on. Even, so that the last one is kept.
    constexpr std::size_t fewest_ends = 1000, most_ends_of_few = 16000, most_numbers = 1000000;

    /// Constraints between the same bodies that may share an impulse.
    constexpr std::size_t least_shared = 3;

    /// Of each of these rows the DoFs of lumped bodies that a fixed rigid unilateral constraint
    /// acts on, by number; empty: another one, or other bodies, too.
    std::vector<std::vector<std::size_t>> lumped_ends(const Structure &structure,
                                                      const Constraints &constraints,
                                                      const std::vector<std::size_t> &rows)
    {
      double most_dofs = 1.;
      for (std::size_t k = 0; k < structure.size(); ++k)
        if (structure[k].is_lumped())
          most_dofs = std::max<double>(most_dofs, structure[k].n_dofs());
      const auto stride = static_cast<std::size_t>(structure.communicator().max(most_dofs));
      MatrixEntries acts_on;
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (const std::vector<Term> *const form : constraints[rows[i]].forms())
          for (const Term &term : *form)
          {
            const bool is_lumped = structure[term.substructure].is_lumped();
            for (const unsigned int dof : term.form.index)
              acts_on.add(i, structure.number(term.substructure) * stride + (is_lumped ? dof : 0),
                          is_lumped);
          }
      gather(structure.communicator(), acts_on);
      std::vector<std::vector<std::size_t>> ends(rows.size());
      std::vector<char> is_shared(rows.size(), 0);
      for (std::size_t i = 0; i < rows.size(); ++i)
        is_shared[i] = constraints[rows[i]].cone.may_open() &&
                       constraints[rows[i]].spring.is_rigid() && !constraints.slides(rows[i]);
      for (std::size_t e = 0; e < acts_on.size(); ++e)
      {
        ends[acts_on.row[e]].push_back(acts_on.column[e]);
        if (acts_on.value[e] == 0.)
          is_shared[acts_on.row[e]] = 0;
      }
      for (std::size_t i = 0; i < ends.size(); ++i)
      {
        std::sort(ends[i].begin(), ends[i].end());
        ends[i].erase(std::unique(ends[i].begin(), ends[i].end()), ends[i].end());
        if (!is_shared[i])
          ends[i].clear();
      }
      return ends;
    }
  } // namespace

  ImpulseRecord::ImpulseRecord(const Structure &structure, const Constraints &constraints,
                               const ConnectedBodies &groups, const State &start)
      : times(1, start.time)
  {
    for (const std::size_t i : constraints.common_rows())
      if (!constraints[i].is_cut())
      {
        rows.push_back(i);
        multiplier.push_back(start.multiplier[i]);
      }
    const auto ends = lumped_ends(structure, constraints, rows);
    std::map<std::pair<std::vector<std::size_t>, bool>, std::vector<std::size_t>> with_ends;
    for (std::size_t i = 0; i < ends.size(); ++i)
      with_ends[{ends[i], constraints[rows[i]].rotational}].push_back(i);
    item_of.resize(ends.size());
    for (std::size_t i = 0; i < ends.size(); ++i)
    {
      const std::vector<std::size_t> &alike = with_ends[{ends[i], constraints[rows[i]].rotational}];
      const bool is_shared = !ends[i].empty() && alike.size() >= least_shared;
      if (is_shared && alike.front() < i)
      {
        item_of[i] = item_of[alike.front()];
        continue;
      }
      item_of[i] = items.size();
      items.push_back({rows[i], 2 * groups.of_constraint(rows[i]) + constraints[rows[i]].rotational,
                       constraints[rows[i]].cone.may_open()});
    }
    most_ends = std::clamp(most_numbers / std::max<std::size_t>(1, items.size()), fewest_ends,
                           most_ends_of_few) /
                2 * 2;
    impulse.assign(items.size(), 0.);
    impulses.reserve(std::min((most_ends + 1) * items.size(), most_numbers));
    impulses = impulse;
  }

  void ImpulseRecord::record(const State &state, const StepReport &report)
  {
    for (std::size_t i = 0; i < multiplier.size(); ++i)
    {
      const double N = state.multiplier[rows[i]];
      impulse[item_of[i]] +=
          (report.is_mean(rows[i]) ? N : .5 * (N + multiplier[i])) * state.last_step;
      multiplier[i] = N;
    }
    if (n_steps++ % stride != 0) // the last end is none of those to be kept
    {
      times.pop_back();
      impulses.resize(impulses.size() - impulse.size());
    }
    times.push_back(state.time);
    impulses.insert(impulses.end(), impulse.begin(), impulse.end());
    if (times.size() > most_ends && n_steps % stride == 0)
      keep_every_second_end();
  }

  void ImpulseRecord::keep_every_second_end()
  {
    const std::size_t n_kept = (times.size() + 1) / 2, n = impulse.size();
    for (std::size_t k = 1; k < n_kept; ++k)
    {
      times[k] = times[2 * k];
      std::copy_n(impulses.begin() + static_cast<std::ptrdiff_t>(2 * k * n), n,
                  impulses.begin() + static_cast<std::ptrdiff_t>(k * n));
    }
    times.resize(n_kept);
    impulses.resize(n_kept * n);
    stride *= 2;
  }

  std::vector<ImpulseRecord::Instant>
  ImpulseRecord::instants(const std::vector<double> &of_times) const
  {
    std::vector<Instant> result;
    std::size_t next = 1;
    for (const double t : of_times)
    {
      while (next + 1 < times.size() && times[next] < t)
        ++next;
      result.push_back(
          {next, std::min(1., (t - times[next - 1]) / (times[next] - times[next - 1]))});
    }
    return result;
  }

  double ImpulseRecord::at(const Instant &instant, const std::size_t item) const
  {
    const double *const behind = impulses.data() + instant.next * items.size() + item;
    const double before = *(behind - items.size());
    return before + instant.part * (*behind - before);
  }

  ImpulseRecord::Difference ImpulseRecord::difference(const ImpulseRecord &other,
                                                      std::vector<double> largest,
                                                      const std::vector<double> &late,
                                                      const double shift,
                                                      const double rounding) const
  {
    Difference result;
    if (other.times.size() < 2)
      return result;
    const std::size_t n = items.size(), n_times = times.size();
    // The ends of steps, and the times that are a bit earlier and later than each of them.
    std::vector<double> shifted[2] = {times, times};
    for (std::size_t k = 1; k < n_times; ++k)
    {
      const double time = shift * (times[k] - times[k - 1]);
      shifted[0][k] -= time;
      shifted[1][k - 1] += time;
    }
    const std::vector<Instant> same = other.instants(times), earlier = other.instants(shifted[0]),
                               later = other.instants(shifted[1]);
    std::vector<double> own = largest;
    for (std::size_t k = 0; k < n_times; ++k)
      for (std::size_t i = 0; i < n; ++i)
      {
        double &of_others = largest[items[i].group], &of_own = own[items[i].group];
        of_others = std::max(of_others, std::fabs(other.at(same[k], i)));
        of_own = std::max(of_own, std::fabs(impulses[k * n + i]));
      }
    for (std::size_t q = 0; q < own.size(); ++q)
      if (own[q] > much_smaller * largest[q])
        largest[q] = own[q];
    std::size_t n_both = 0;
    for (; n_both < n_times && times[n_both] <= other.times.back() + rounding; ++n_both)
      ;
    for (std::size_t k = 0; k < n_both; ++k)
      for (std::size_t i = 0; i < n; ++i)
      {
        const std::size_t q = items[i].group;
        std::size_t first = k, last = k;
        while (first > 0 && times[k] - times[first - 1] <= shift * late[q])
          --first;
        while (last + 1 < n_both && times[last + 1] - times[k] <= shift * late[q])
          ++last;
        const auto of_own = [&](const std::size_t j) { return impulses[j * n + i]; };
        const auto of_others = [&](const std::size_t j) {
          return other.at(j <= last ? same[j] : j == last + 1 ? earlier[k] : later[k], i);
        };
        double off = distance_to_range(of_own(k), first, last + 2, of_others);
        // Near the end an impact that is early here would follow there.
        if (last + 1 == n_both && k > 0)
          off = std::min(
              off, distance_to_range(other.at(same[k], i), std::min(first, k - 1), k, of_own));
        if (const double d = ratio(off, largest[q]); d > result.largest || d != d)
          std::tie(result.largest, result.row) = std::pair(d, items[i].row);
        const double at_end = ratio(std::fabs(of_own(k) - other.at(same[k], i)), largest[q]);
        if (k + 1 == n_both && items[i].may_open && at_end > result.at_end)
          std::tie(result.at_end, result.row_at_end) = std::pair(at_end, items[i].row);
      }
    return result;
  }
} // namespace taut
