// SPDX-License-Identifier: LGPL-2.1-or-later
#include "extended_complementarity.h"

namespace extremes
{
  namespace
  {
    const Number tie("1e-70");
  } // namespace

  Number last_place(const std::size_t i)
  {
    return Number(0x1p-53) * Number(i % 3 == 0 ? 1. : i % 3 == 1 ? .5 : 1.5);
  }

  Vector principal_pivoting(const Matrix &F, const Vector &d, const std::vector<char> &unilateral,
                            std::vector<char> closed)
  {
    const std::size_t m = d.size();
    for (unsigned int iteration = 0; iteration < 20000; ++iteration)
    {
      std::vector<std::size_t> set;
      for (std::size_t k = 0; k < m; ++k)
        if (closed[k])
          set.push_back(k);
      Matrix sub(set.size());
      Vector rhs(set.size());
      for (std::size_t p = 0; p < set.size(); ++p)
      {
        rhs[p] = -d[set[p]];
        for (std::size_t q = 0; q < set.size(); ++q)
          sub(p, q) = F(set[p], set[q]);
      }
      Cholesky factor;
      if (!factor.factor(sub))
        throw std::logic_error("the extended F is singular");
      const Vector x = factor.solve(rhs);
      Vector result(Number(0), m);
      for (std::size_t p = 0; p < set.size(); ++p)
        result[set[p]] = x[p];
      bool changed = false;
      for (std::size_t k = 0; k < m && !changed; ++k)
      {
        if (!unilateral[k])
          continue;
        Number terms = abs(d[k]), sum = d[k];
        for (std::size_t l = 0; l < m; ++l)
        {
          sum += F(k, l) * result[l];
          terms += abs(F(k, l) * result[l]);
        }
        changed = closed[k] ? F(k, k) * result[k] < -tie * terms : sum < -tie * terms;
        if (changed)
          closed[k] = !closed[k];
      }
      if (!changed)
        return result;
    }
    throw std::logic_error("principal pivoting does not end");
  }
} // namespace extremes
