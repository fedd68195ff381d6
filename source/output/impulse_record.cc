// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/distance_to_range.h"

#include "output/impulse_record.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Ends of steps with impulses; of more steps every second one, or fourth, and so on. Even, so
    /// that the last one is kept.
    constexpr std::size_t most_ends = 16000;
  } // namespace

  ImpulseRecord::ImpulseRecord(const State &start)
      : impulse(start.multiplier.size(), 0.), multiplier(start.multiplier), times(1, start.time),
        impulses(impulse)
  {
  }

  void ImpulseRecord::record(const State &state, const StepReport &report)
  {
    for (std::size_t i = 0; i < impulse.size(); ++i)
    {
      const double N = state.multiplier[i];
      impulse[i] += (report.is_mean(i) ? N : .5 * (N + multiplier[i])) * state.last_step;
      multiplier[i] = N;
    }
    if (++n_steps % stride != 0)
      return;
    times.push_back(state.time);
    impulses.insert(impulses.end(), impulse.begin(), impulse.end());
    if (times.size() > most_ends)
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

  /// Impulses at given times, linear between its own.
  std::vector<double> ImpulseRecord::at(const std::vector<double> &instants) const
  {
    std::vector<double> result;
    const std::size_t n = impulse.size();
    std::size_t next = 1;
    for (const double t : instants)
    {
      while (next + 1 < times.size() && times[next] < t)
        ++next;
      const double part = std::min(1., (t - times[next - 1]) / (times[next] - times[next - 1]));
      const double *const before = impulses.data() + (next - 1) * n, *const behind = before + n;
      for (std::size_t i = 0; i < n; ++i)
        result.push_back(before[i] + part * (behind[i] - before[i]));
    }
    return result;
  }

  std::pair<double, std::size_t> ImpulseRecord::difference(const ImpulseRecord &other,
                                                           const ConnectedBodies &groups,
                                                           std::vector<double> largest,
                                                           const std::vector<double> &late,
                                                           const double rounding) const
  {
    std::pair<double, std::size_t> result(0., -1);
    if (other.times.size() < 2)
      return result;
    const std::vector<double> others = other.at(times);
    const std::size_t n = impulse.size();
    for (std::size_t e = 0; e < others.size(); ++e)
    {
      double &of_group = largest[groups.of_constraint(e % n)];
      of_group = std::max(of_group, std::fabs(others[e]));
    }
    for (std::size_t k = 0; k < times.size() && times[k] <= other.times.back() + rounding; ++k)
      for (std::size_t i = 0; i < n; ++i)
      {
        const std::size_t g = groups.of_constraint(i);
        std::size_t first = k > 0 ? k - 1 : 0, last = std::min(k + 1, times.size() - 1);
        while (first > 0 && times[k] - times[first] < late[g])
          --first;
        while (last + 1 < times.size() && times[last] - times[k] < late[g])
          ++last;
        const double d =
            ratio(distance_to_range(impulses[k * n + i], first, last,
                                    [&](const std::size_t j) { return others[j * n + i]; }),
                  largest[g]);
        if (d > result.first || d != d)
          result = {d, i};
      }
    return result;
  }
} // namespace taut
