// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/natural_coarse_problem.h"

#include <taut/interface/contact_schur_operator.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace taut
{
  ContactSchurOperator::ContactSchurOperator(const Lasting<FactoredStructure> solvers,
                                             const Lasting<BodyConstraints> lasting)
      : ConstraintOperator(std::make_shared<const RowMap>(
            static_cast<const FactoredStructure &>(solvers).structure().communicator(),
            static_cast<const BodyConstraints &>(lasting).rows(),
            static_cast<const BodyConstraints &>(lasting).all().n_of_all())),
        solvers(solvers), body_constraints(lasting), compliance(body_constraints.all().size(), 0.),
        shift(compliance.size(), 0.), active(compliance.size(), 1), position(compliance.size(), 0)
  {
    set_positions();
  }

  void ContactSchurOperator::set_positions()
  {
    const Constraints &all = body_constraints.all();
    const std::vector<std::size_t> &held = rows().held();
    for (std::size_t p = 0; p < held.size(); ++p)
      position[all.index(held[p])] = p;
    own.clear();
    for (const std::size_t number : rows().owned())
      own.push_back(all.index(number));
  }

  void ContactSchurOperator::update_rows()
  {
    if (rows().communicator().size() == 1)
      return;
    std::vector<std::size_t> held = body_constraints.rows();
    const auto holds = [&](const std::size_t i)
    { return std::binary_search(rows().held().begin(), rows().held().end(), i); };
    if (!rows().communicator().any(!std::all_of(held.begin(), held.end(), holds)))
      return;
    own_rows = std::make_shared<const RowMap>(rows().communicator(), std::move(held),
                                              body_constraints.all().n_of_all());
    set_positions();
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

  /// Motions of held rows under their multipliers.
  void ContactSchurOperator::add_solves() const
  {
    motion.assign(multiplier.size(), 0.);
    for (std::size_t k = 0; k < body_constraints.size(); ++k)
    {
      // Body after body: its vector stays in the cache between loads, solution and motions.
      bool is_loaded = false;
      for (const BodyConstraints::Entry &entry : body_constraints[k])
        if (const double x = multiplier[position[entry.constraint]];
            active[entry.constraint] && x != 0.)
        {
          if (!is_loaded)
            work.assign(solvers.structure()[k].n_dofs(), 0.);
          is_loaded = true;
          entry.form.add_to(x, work);
        }
      if (!is_loaded)
        continue;
      solvers[k].solve(work);
      ++local_solves;
      for (const BodyConstraints::Entry &entry : body_constraints[k])
        if (active[entry.constraint])
          motion[position[entry.constraint]] += entry.form.dot(work);
    }
  }

  void ContactSchurOperator::apply(const std::vector<double> &x, std::vector<double> &y) const
  {
    scaled.resize(own.size());
    for (std::size_t p = 0; p < own.size(); ++p)
      scaled[p] = x[own[p]];
    apply_owned(scaled, projected);
    y.assign(x.size(), 0.);
    for (std::size_t p = 0; p < own.size(); ++p)
      y[own[p]] = projected[p];
    body_constraints.all().sum(y);
  }

  /// y = F x on owned rows.
  void ContactSchurOperator::apply_owned(const std::vector<double> &x, std::vector<double> &y) const
  {
    ++applications;
    multiplier.resize(rows().held().size());
    rows().copy_to_holders(x.data(), multiplier.data());
    add_solves();
    y.resize(x.size());
    rows().add_shares(motion.data(), y.data());
    for (std::size_t p = 0; p < x.size(); ++p)
    {
      const std::size_t i = own[p];
      y[p] = active[i] ? y[p] + (compliance[i] + shift[i]) * x[p] : x[p];
    }
  }

  void ContactSchurOperator::scaled_apply(const std::vector<double> &x,
                                          std::vector<double> &y) const
  {
    const auto D = [&](const std::size_t p)
    { return scale && active[own[p]] ? (*scale)[own[p]] : 1.; };
    scaled.resize(x.size());
    for (std::size_t p = 0; p < x.size(); ++p)
      scaled[p] = D(p) * x[p];
    apply_owned(scaled, y);
    for (std::size_t p = 0; p < x.size(); ++p)
      y[p] = active[own[p]] ? D(p) * y[p] : x[p];
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
