// SPDX-License-Identifier: LGPL-2.1-or-later

#include "time/row_flexibilities.h"
#include "base/groups.h"
#include "time/contact_resolution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Relative shift that makes a system with dependent constraints definite: well above the
    /// smallest pivot of the factors, 1e-12 of the diagonal. Flexibilities are compared with bounds
    /// of two digits.
    constexpr double shift_of_dependent_rows = 1e-9;
  } // namespace

  RowFlexibilities::RowFlexibilities(const Structure &structure, const Constraints &constraints,
                                     const SolverParameters &parameters, const double step)
      : structure(structure), constraints(constraints), c(generalised_alpha(step, .8)),
        solvers(structure, parameters.local_solver),
        schur(make_schur_complement(parameters.interface, solvers, constraints))
  {
    structure.communicator().agree([&] { solvers.factor(c.mass_factor(), c.velocity); });
    S.resize(constraints.size());
    for (std::size_t i = 0; i < S.size(); ++i)
      S[i] = constraints[i].spring.compliance(c.velocity);
    schur->setup(S);
  }

  double RowFlexibilities::of_body(const Term &term) const
  {
    double sum = solvers[term.substructure].flexibility(term.form);
    const auto &modes = solvers.rigid_body_modes()[term.substructure];
    for (std::size_t v = 0; v < modes.vectors.size(); ++v)
      sum += std::pow(term.form.dot(modes.vectors[v]), 2) / modes.resistance[v];
    return sum;
  }

  void RowFlexibilities::column(const std::size_t i, const std::vector<std::size_t> &closed,
                                std::vector<double> &result) const
  {
    ComplementarityOperator &F = schur->matrix();
    std::vector<std::size_t> set;
    for (const std::size_t j : closed)
      if (F.diagonal(j) > 0.)
        set.push_back(j);
    std::vector<double> unit(constraints.size(), 0.), x, of_x;
    const bool is_here = i < unit.size();
    if (is_here)
      unit[i] = 1.;
    F.apply(unit, result);
    if (is_here)
      result[i] -= S[i];
    add_modes(i, result);
    if (!constraints.any(!set.empty()) ||
        (!F.solve(set, result, 0., x) && !F.solve(set, result, shift_of_dependent_rows, x)))
      return;
    F.apply(x, of_x);
    for (std::size_t j = 0; j < result.size(); ++j)
      result[j] -= of_x[j];
  }

  /// Adds rigid body modes of bodies whose inertia is lost in their stiffness.
  void RowFlexibilities::add_modes(const std::size_t i, std::vector<double> &result) const
  {
    if (!solvers.has_rigid_body_modes())
      return;
    std::vector<double> sums(constraints.size(), 0.);
    for (std::size_t k = 0; k < structure.size() && i < constraints.size(); ++k)
    {
      const auto &modes = solvers.rigid_body_modes()[k];
      for (std::size_t v = 0; v < modes.vectors.size(); ++v)
        for (const Term &own : constraints[i].terms)
          for (std::size_t j = 0; j < sums.size() && own.substructure == k; ++j)
            for (const Term &other : constraints[j].terms)
              if (other.substructure == k)
                sums[j] += own.form.dot(modes.vectors[v]) * other.form.dot(modes.vectors[v]) /
                           modes.resistance[v];
    }
    constraints.sum(sums);
    for (std::size_t j = 0; j < sums.size(); ++j)
      result[j] += sums[j];
  }

  const std::vector<double> &WholeBodies::flexibilities(const std::vector<std::size_t> &wanted,
                                                        ComplementarityOperator &F)
  {
    joints.clear();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (constraints[i].cone.is_free() && constraints[i].spring.is_rigid() && F.diagonal(i) > 0.)
        joints.push_back(i);
    if (!constraints.shared()) // allocates nothing
    {
      F.condensed_diagonal(wanted, joints, shift_of_dependent_rows, nullptr, result);
      return result;
    }
    rows.clear();
    for (const std::size_t number : constraints.numbers_of(wanted))
      rows.push_back(constraints.index(number));
    F.condensed_diagonal(rows, joints, shift_of_dependent_rows, constraints.shared(), result);
    return result;
  }

  namespace
  {
    /// Accuracy of the largest eigenvalue, which is compared with bounds of two digits, and bound
    /// of iterations: the quotients bound the eigenvalue from above after any number of them.
    constexpr double eigenvalue_tolerance = .01;
    constexpr int most_power_steps = 200;
  } // namespace

  double largest_eigenvalue(const std::vector<std::vector<double>> &G,
                            const std::vector<std::size_t> &group)
  {
    std::vector<double> x(group.size(), 1.), y(group.size());
    double above = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < most_power_steps; ++iteration)
    {
      double highest = 0., lowest = std::numeric_limits<double>::infinity(), largest = 0.;
      for (std::size_t a = 0; a < group.size(); ++a)
      {
        y[a] = 0.;
        for (std::size_t b = 0; b < group.size(); ++b)
          y[a] += G[group[a]][group[b]] * x[b];
        highest = std::max(highest, y[a] / x[a]);
        lowest = std::min(lowest, y[a] / x[a]);
        largest = std::max(largest, y[a]);
      }
      above = std::min(above, highest);
      if (highest <= (1. + eigenvalue_tolerance) * lowest || !(largest > 0.))
        break;
      // The mean of both vectors converges even if the matrix only swaps them.
      for (std::size_t a = 0; a < group.size(); ++a)
        x[a] = std::max(.5 * (x[a] + y[a] / largest), std::numeric_limits<double>::min());
    }
    return above;
  }

  std::vector<std::vector<std::size_t>> coupled_rows(const std::vector<std::vector<double>> &G)
  {
    Groups groups(G.size());
    for (std::size_t a = 0; a < G.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (G[a][b] > 0.)
          groups.join(a, b);
    return groups.members();
  }
} // namespace taut
