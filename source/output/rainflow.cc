// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/rainflow.h"

#include <cmath>
#include <cstddef>

namespace taut
{
  void add_reversal(std::vector<double> &all, const double value)
  {
    const std::size_t n = all.size();
    if (n > 0 && value == all[n - 1])
      return;
    if (n > 1 && (value > all[n - 1]) == (all[n - 1] > all[n - 2]))
      all[n - 1] = value; // goes on in the same direction
    else
      all.push_back(value);
  }

  std::vector<double> reversals(const std::vector<double> &record)
  {
    std::vector<double> result;
    for (const double x : record)
      add_reversal(result, x);
    return result;
  }

  std::vector<LoadCycle> rainflow(const std::vector<double> &record)
  {
    std::vector<LoadCycle> cycles;
    const auto add = [&](const double from, const double to, const double count) {
      cycles.push_back({std::fabs(to - from), .5 * (from + to), count});
    };
    std::vector<double> open; // reversals whose cycles are not closed
    for (const double reversal : reversals(record))
    {
      open.push_back(reversal);
      while (open.size() >= 3)
      {
        const std::size_t n = open.size();
        const double before = open[n - 3], begin = open[n - 2], end = open[n - 1];
        if (std::fabs(end - begin) < std::fabs(begin - before))
          break;
        // With the first reversal in it, the earlier range is half a cycle.
        add(before, begin, n == 3 ? .5 : 1.);
        if (n == 3)
          open = {begin, end};
        else
          open.erase(open.end() - 3, open.end() - 1);
      }
    }
    for (std::size_t i = 1; i < open.size(); ++i)
      add(open[i - 1], open[i], .5);
    return cycles;
  }
} // namespace taut
