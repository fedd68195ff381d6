// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/coarse_space.h"

#include "base/gather_entries.h"
#include "base/pivots.h"

#include <map>
#include <numeric>

namespace taut
{
  CoarseSpace::CoarseSpace(const FactoredStructure &solvers,
                           const BodyConstraints &body_constraints)
      : solvers(solvers), body_constraints(body_constraints), responses(body_constraints.size())
  {
    const Communicator &processes = solvers.structure().communicator();
    std::size_t n_own = 0;
    for (std::size_t k = 0; k < solvers.structure().size(); ++k)
    {
      first_column.push_back(n_own);
      null_spaces.push_back(solvers.structure()[k].null_space().vectors);
      n_own += null_spaces.back().size();
    }
    std::vector<std::size_t> sizes;
    processes.gather(n_own, sizes);
    const auto own = sizes.begin() + processes.rank();
    const std::size_t before = std::accumulate(sizes.begin(), own, std::size_t(0));
    n_columns = std::accumulate(own, sizes.end(), before);
    for (std::size_t &first : first_column)
      first += before;
  }

  void CoarseSpace::setup(const std::vector<char> &active, const std::vector<char> &is_changed,
                          const std::vector<double> &compliance)
  {
    set_columns(active);
    solvers.structure().communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < body_constraints.size(); ++k)
            if (is_changed[k])
              add_responses(k, active);
        });
    FZ = {};
    for (const MatrixEntries &response : responses)
      for (std::size_t e = 0; e < response.size(); ++e)
        FZ.add(response.row[e], response.column[e], response.value[e]);
    gather(solvers.structure().communicator(), FZ);
    for (std::size_t i = 0; i < Z.size(); ++i)
      for (const auto &[k, z] : Z[i])
        if (compliance[i] > 0.)
          FZ.add(i, k, compliance[i] * z);
    FZ.compress();
    factor();
  }

  void CoarseSpace::set_columns(const std::vector<char> &active)
  {
    MatrixEntries entries;
    for (std::size_t k = 0; k < body_constraints.size(); ++k)
      for (std::size_t v = 0; v < null_spaces[k].size(); ++v)
        for (const BodyConstraints::Entry &entry : body_constraints[k])
          if (active[entry.constraint])
          {
            const double z = entry.form.dot(null_spaces[k][v]);
            if (z != 0.)
              entries.add(entry.constraint, first_column[k] + v, z);
          }
    gather(solvers.structure().communicator(), entries);
    Z.assign(active.size(), {});
    for (std::size_t e = 0; e < entries.size(); ++e)
      Z[entries.row[e]].emplace_back(entries.column[e], entries.value[e]);
  }

  /// Adds responses of a body to its own columns and those of its neighbours.
  void CoarseSpace::add_responses(const std::size_t k, const std::vector<char> &active)
  {
    responses[k] = {};
    std::map<std::size_t, std::vector<double>> loads;
    for (const BodyConstraints::Entry &entry : body_constraints[k])
      for (const auto &[column, z] : Z[entry.constraint])
      {
        std::vector<double> &load = loads[column];
        load.resize(solvers.structure()[k].n_dofs(), 0.);
        entry.form.add_to(z, load);
      }
    for (auto &[column, load] : loads)
    {
      solvers[k].solve(load);
      for (const BodyConstraints::Entry &entry : body_constraints[k])
        if (active[entry.constraint])
          responses[k].add(entry.constraint, column, entry.form.dot(load));
    }
  }

  void CoarseSpace::factor()
  {
    if (n_columns == 0)
      return;
    SymmetricEntries entries;
    std::vector<double> diagonal(n_columns, 0.);
    for (std::size_t e = 0; e < FZ.size(); ++e)
      for (const auto &[k, z] : Z[FZ.row[e]])
        if (k <= static_cast<std::size_t>(FZ.column[e]))
        {
          entries.add(FZ.column[e], k, z * FZ.value[e]);
          if (k == static_cast<std::size_t>(FZ.column[e]))
            diagonal[k] += z * FZ.value[e];
        }
    for (std::size_t k = 0; k < n_columns; ++k)
      // Rigid body modes of a group without active rows would make E singular and the columns of Z
      // dependent; their part in Z E^-1 Z^T is zero.
      entries.add(k, k, diagonal[k] > 0. ? dependence_shift * diagonal[k] : 1.);
    entries.compress();
    E.factor(n_columns, entries, 0.);
  }

  void CoarseSpace::solve(const std::vector<double> &r, std::vector<double> &x,
                          std::vector<double> &Fx) const
  {
    x.assign(r.size(), 0.);
    Fx.assign(r.size(), 0.);
    if (n_columns == 0)
      return;
    amplitude.assign(n_columns, 0.);
    for (std::size_t i = 0; i < r.size(); ++i)
      for (const auto &[k, z] : Z[i])
        amplitude[k] += z * r[i];
    E.solve(amplitude);
    for (std::size_t i = 0; i < r.size(); ++i)
      for (const auto &[k, z] : Z[i])
        x[i] += z * amplitude[k];
    for (std::size_t e = 0; e < FZ.size(); ++e)
      Fx[FZ.row[e]] += FZ.value[e] * amplitude[FZ.column[e]];
  }

  void CoarseSpace::project(std::vector<double> &z) const
  {
    if (n_columns == 0)
      return;
    amplitude.assign(n_columns, 0.);
    for (std::size_t e = 0; e < FZ.size(); ++e)
      amplitude[FZ.column[e]] += FZ.value[e] * z[FZ.row[e]];
    E.solve(amplitude);
    for (std::size_t i = 0; i < z.size(); ++i)
      for (const auto &[k, value] : Z[i])
        z[i] -= value * amplitude[k];
  }
} // namespace taut
