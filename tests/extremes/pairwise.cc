// SPDX-License-Identifier: LGPL-2.1-or-later
// Covering arrays of strength two; see pairwise.h.
#include "pairwise.h"

namespace extremes
{
  std::vector<std::vector<std::size_t>> pairwise(const std::vector<std::size_t> &levels,
                                                 const unsigned int seed)
  {
    using Pair = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>;
    const std::size_t n = levels.size();
    const auto pair = [](std::size_t d, std::size_t x, std::size_t e, std::size_t y)
    { return d < e ? Pair(d, x, e, y) : Pair(e, y, d, x); };
    std::set<Pair> open;
    for (std::size_t d = 0; d < n; ++d)
      for (std::size_t e = d + 1; e < n; ++e)
        for (std::size_t x = 0; x < levels[d]; ++x)
          for (std::size_t y = 0; y < levels[e]; ++y)
            open.emplace(d, x, e, y);

    std::mt19937 random(seed);
    std::vector<std::vector<std::size_t>> constraints;
    while (!open.empty())
    {
      // Of some constraints that begin with an open pair, the one that closes most.
      std::vector<std::size_t> best;
      std::size_t most = 0;
      for (int attempt = 0; attempt < 30; ++attempt)
      {
        auto first = open.begin();
        std::advance(first, random() % std::min<std::size_t>(open.size(), 50));
        const auto [d0, x0, e0, y0] = *first;
        std::vector<std::size_t> constraint(n, 0), order(n);
        std::vector<char> is_set(n, 0);
        constraint[d0] = x0;
        constraint[e0] = y0;
        is_set[d0] = is_set[e0] = 1;
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        std::size_t closed = 1;
        for (const std::size_t d : order)
        {
          if (is_set[d])
            continue;
          std::size_t best_gain = 0, best_level = random() % levels[d];
          for (std::size_t x = 0; x < levels[d]; ++x)
          {
            std::size_t gain = 0;
            for (std::size_t e = 0; e < n; ++e)
              gain += is_set[e] && open.count(pair(d, x, e, constraint[e]));
            if (gain > best_gain)
            {
              best_gain = gain;
              best_level = x;
            }
          }
          constraint[d] = best_level;
          is_set[d] = 1;
          closed += best_gain;
        }
        if (closed > most)
        {
          most = closed;
          best = constraint;
        }
      }
      for (std::size_t d = 0; d < n; ++d)
        for (std::size_t e = d + 1; e < n; ++e)
          open.erase({d, best[d], e, best[e]});
      constraints.push_back(best);
    }
    return constraints;
  }
} // namespace extremes
