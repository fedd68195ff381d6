// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/interface/contact_schur_operator.h>

#include <Epetra_MultiVector.h>

#include <algorithm>

namespace taut
{
  ContactSchurOperator::ContactSchurOperator(const FactoredStructure &solvers,
                                             const ContactRows &rows)
      : solvers(solvers), rows(rows), map(static_cast<int>(rows.size()), 0, communicator),
        compliance(rows.size(), 0.), shift(rows.size(), 0.), active(rows.size(), 1),
        multiplier(rows.size()), work(solvers.structure().zero())
  {
  }

  void ContactSchurOperator::restrict_to(const std::vector<std::size_t> &set)
  {
    std::fill(active.begin(), active.end(), 0);
    for (const std::size_t i : set)
      active[i] = 1;
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
    for (std::size_t i = 0; i < active.size(); ++i)
      multiplier[i] = active[i] ? x[i] : 0.;
    for (auto &block : work)
      std::fill(block.begin(), block.end(), 0.);
    rows.add_forces(multiplier, work);
    solvers.solve(work);
    for (std::size_t i = 0; i < active.size(); ++i)
      multiplier[i] = active[i] ? evaluate(rows[i].terms, work) : 0.;
    solvers.structure().communicator().sum(multiplier);
    for (std::size_t i = 0; i < active.size(); ++i)
      y[i] = active[i] ? multiplier[i] + (compliance[i] + shift[i]) * x[i] : x[i];
  }

  int ContactSchurOperator::Apply(const Epetra_MultiVector &X, Epetra_MultiVector &Y) const
  {
    for (int v = 0; v < X.NumVectors(); ++v)
      apply(X[v], Y[v]);
    return 0;
  }
} // namespace taut
