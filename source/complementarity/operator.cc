// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/operator.h"

namespace taut
{
  void ComplementarityOperator::condensed_diagonal(const std::vector<std::size_t> &wanted,
                                                   const std::vector<std::size_t> &set,
                                                   const double shift, std::vector<double> &result)
  {
    std::vector<double> unit(size(), 0.), column, x;
    result.assign(size(), 0.);
    for (const std::size_t i : wanted)
    {
      result[i] = diagonal(i);
      if (set.empty())
        continue;
      unit[i] = 1.;
      apply(unit, column);
      unit[i] = 0.;
      if (!solve(set, column, 0., x) && !solve(set, column, shift, x))
        continue;
      for (const std::size_t b : set)
        result[i] -= column[b] * x[b];
    }
  }
} // namespace taut
