// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/natural_coarse_problem.h"

#include <taut/interface/contact_schur_operator.h>

#include <algorithm>

namespace taut
{
  ContactSchurOperator::ContactSchurOperator(const Lasting<FactoredStructure> solvers,
                                             const Lasting<BodyConstraints> body_constraints,
                                             const std::size_t n_constraints)
      : ConstraintOperator(n_constraints), solvers(solvers), body_constraints(body_constraints),
        compliance(n_constraints, 0.), shift(n_constraints, 0.), active(n_constraints, 1)
  {
  }

  void ContactSchurOperator::unrestrict()
  {
    std::fill(active.begin(), active.end(), 1);
  }

  void ContactSchurOperator::set_shift(const double factor, const std::vector<double> &diagonal)
  {
    for (std::size_t i = 0; i < shift.size(); ++i)
      shift[i] = factor * diagonal[i];
  }

  void ContactSchurOperator::apply(const double *x, double *y) const
  {
    // An iteration from zero begins with this product.
    if (std::all_of(x, x + active.size(), [](const double value) { return value == 0.; }))
    {
      std::fill(y, y + active.size(), 0.);
      return;
    }
    ++applications;
    share.assign(active.size(), 0.);
    for (std::size_t k = 0; k < body_constraints.size(); ++k)
    {
      // Body after body: its vector stays in the cache between loads, solution and motions.
      bool is_loaded = false;
      for (const BodyConstraints::Entry &entry : body_constraints[k])
        if (active[entry.constraint] && x[entry.constraint] != 0.)
        {
          if (!is_loaded)
            work.assign(solvers.structure()[k].n_dofs(), 0.);
          is_loaded = true;
          entry.form.add_to(x[entry.constraint], work);
        }
      if (!is_loaded)
        continue;
      solvers[k].solve(work);
      ++local_solves;
      for (const BodyConstraints::Entry &entry : body_constraints[k])
        if (active[entry.constraint])
          share[entry.constraint] += entry.form.dot(work);
    }
    solvers.structure().communicator().sum(share);
    for (std::size_t i = 0; i < active.size(); ++i)
      y[i] = active[i] ? share[i] + (compliance[i] + shift[i]) * x[i] : x[i];
  }

  void ContactSchurOperator::scaled_apply(const std::vector<double> &x,
                                          std::vector<double> &y) const
  {
    const auto D = [this](const std::size_t i) { return scale ? (*scale)[i] : 1.; };
    scaled.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      scaled[i] = active[i] ? D(i) * x[i] : x[i];
    y.resize(x.size());
    apply(scaled.data(), y.data());
    for (std::size_t i = 0; i < x.size(); ++i)
      y[i] = active[i] ? D(i) * y[i] : x[i];
  }

  void ContactSchurOperator::multiply(const std::vector<double> &x, std::vector<double> &y) const
  {
    if (!projector)
      return scaled_apply(x, y);
    projected = x;
    projector->project(projected);
    scaled_apply(projected, y);
    projector->project_residual(y);
  }
} // namespace taut
