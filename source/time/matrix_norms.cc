// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/matrix_norms.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  PerKind largest(const Substructure &body, const std::vector<double> &x)
  {
    PerKind result = {0., 0.};
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      double &m = result[body.kind(i)];
      m = std::max(m, std::fabs(x[i]));
    }
    return result;
  }

  KindNorm::KindNorm(const Substructure &body, const SymmetricMatrix &matrix)
  {
    std::vector<PerKind> rows(body.n_dofs(), PerKind{0., 0.});
    matrix.visit(
        [&](unsigned int i, unsigned int j, double value)
        {
          rows[i][body.kind(j)] += std::fabs(value);
          if (i != j)
            rows[j][body.kind(i)] += std::fabs(value);
        });
    for (const ConstrainedDof &constraint : body.constraints())
      rows[constraint.dof] = {0., 0.};
    sums = {};
    for (unsigned int i = 0; i < rows.size(); ++i)
      for (int c = 0; c < 2; ++c)
        sums[body.kind(i)][c] = std::max(sums[body.kind(i)][c], rows[i][c]);
  }

  PerKind KindNorm::times(const PerKind &x) const
  {
    return {sums[0][0] * x[0] + sums[0][1] * x[1], sums[1][0] * x[0] + sums[1][1] * x[1]};
  }
} // namespace taut
