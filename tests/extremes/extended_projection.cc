// SPDX-License-Identifier: LGPL-2.1-or-later
#include "extended_projection.h"

#include "extended_complementarity.h"

namespace extremes
{
  namespace
  {
    /// Part of its flexibility that a contact is softer by, as ExtendedRun has it.
    const Number shared_by("1e-30");
  } // namespace

  ExtendedProjection::ExtendedProjection(const ExtendedModel &model, const Matrix &M,
                                         const bool as_double)
      : as_double(as_double)
  {
    for (std::size_t i = 0; i < model.n_dofs(); ++i)
      if (!model.held[i] && !model.is_massless(i))
        dofs.push_back(i);
    Matrix own(dofs.size());
    for (std::size_t i = 0; i < dofs.size(); ++i)
      for (std::size_t j = 0; j < dofs.size(); ++j)
        own(i, j) = M(dofs[i], dofs[j]);
    is_definite = factor_of_M.factor(own);
  }

  void ExtendedProjection::project(std::vector<ProjectedContact> &contacts, Vector &V) const
  {
    if (!is_definite)
      throw std::logic_error("a projection of velocities needs a mass matrix that is definite");
    std::vector<Vector> rows, columns;
    std::vector<ProjectedContact *> taking;
    for (ProjectedContact &contact : contacts)
    {
      Vector row(dofs.size());
      for (std::size_t i = 0; i < dofs.size(); ++i)
        row[i] = contact.form[dofs[i]];
      if (dot(row, row) == 0)
        continue;
      columns.push_back(factor_of_M.solve(row));
      rows.push_back(std::move(row));
      taking.push_back(&contact);
    }
    const std::size_t m = taking.size();
    Matrix f(m);
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t l = 0; l < m; ++l)
        f(k, l) = dot(rows[k], columns[l]);
    for (std::size_t k = 0; k < m; ++k)
      f(k, k) *= 1 + taking[k]->softness + shared_by;
    Vector d(m);
    for (std::size_t k = 0; k < m; ++k)
    {
      d[k] = taking[k]->rate;
      for (std::size_t l = 0; l < m; ++l)
        d[k] -= f(k, l) * taking[l]->impulse;
    }
    if (as_double)
      for (std::size_t k = 0; k < m; ++k)
        f(k, k) *= 1 + last_place(k);
    Vector P = principal_pivoting(f, d, std::vector<char>(m, 1), std::vector<char>(m, 1));
    for (std::size_t k = 0; k < m; ++k)
    {
      if (as_double)
        P[k] *= 1 + last_place(k + 1);
      for (std::size_t i = 0; i < dofs.size(); ++i)
        V[dofs[i]] += columns[k][i] * (P[k] - taking[k]->impulse);
      taking[k]->impulse = P[k];
    }
  }
} // namespace extremes
