// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/operator.h"
#include "complementarity/shared_rows.h"

namespace taut
{
  void ComplementarityOperator::condensed_diagonal(const std::vector<std::size_t> &wanted,
                                                   const std::vector<std::size_t> &set,
                                                   const double shift, const SharedRows *shared,
                                                   std::vector<double> &result)
  {
    std::vector<double> unit(size(), 0.), column, x, left(1);
    const bool is_empty = !(shared ? shared->max(set.empty() ? 0. : 1.) > 0. : !set.empty());
    result.assign(size(), 0.);
    const auto is_own = [&](const std::size_t row) { return !shared || shared->is_own(row); };
    for (const std::size_t i : wanted)
    {
      const bool is_here = i < size();
      if (is_here)
        result[i] = diagonal(i);
      if (is_empty)
        continue;
      if (is_here)
        unit[i] = 1.;
      apply(unit, column);
      if (is_here)
        unit[i] = 0.;
      if (!solve(set, column, 0., x) && !solve(set, column, shift, x))
        continue;
      left[0] = is_here && is_own(i) ? result[i] : 0.;
      for (const std::size_t b : set)
        if (is_own(b))
          left[0] -= column[b] * x[b];
      if (shared)
        shared->sum(left);
      if (is_here)
        result[i] = left[0];
    }
  }
} // namespace taut
