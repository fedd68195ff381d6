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
    for (const std::size_t i : wanted)
    {
      result[i] = diagonal(i);
      if (is_empty)
        continue;
      unit[i] = 1.;
      apply(unit, column);
      unit[i] = 0.;
      if (!solve(set, column, 0., x) && !solve(set, column, shift, x))
        continue;
      const auto is_own = [&](const std::size_t row) { return !shared || shared->is_own(row); };
      left[0] = is_own(i) ? result[i] : 0.;
      for (const std::size_t b : set)
        if (is_own(b))
          left[0] -= column[b] * x[b];
      if (shared)
        shared->sum(left);
      result[i] = left[0];
    }
  }
} // namespace taut
