// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/coarse_space.h"

#include "base/gather_entries.h"
#include "base/pivots.h"

#include <algorithm>
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
    MatrixEntries entries;
    for (const MatrixEntries &response : responses)
      for (std::size_t e = 0; e < response.size(); ++e)
        entries.add(response.row[e], response.column[e], response.value[e]);
    gather(solvers.structure().communicator(), entries);
    std::vector<double> S;
    body_constraints.all().gather(compliance, S);
    for (std::size_t i = 0; i < Z.size(); ++i)
      for (const auto &[k, z] : Z[i])
        if (S[i] > 0.)
          entries.add(i, k, S[i] * z);
    entries.compress();
    FZ.assign(Z.size(), {});
    for (std::size_t e = 0; e < entries.size(); ++e)
      FZ[entries.row[e]].emplace_back(entries.column[e], entries.value[e]);
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
              entries.add(body_constraints.all().number(entry.constraint), first_column[k] + v, z);
          }
    gather(solvers.structure().communicator(), entries);
    Z.assign(body_constraints.all().n_of_all(), {});
    for (std::size_t e = 0; e < entries.size(); ++e)
      Z[entries.row[e]].emplace_back(entries.column[e], entries.value[e]);
  }

  /// Adds responses of a body to its own columns and those of its neighbours.
  void CoarseSpace::add_responses(const std::size_t k, const std::vector<char> &active)
  {
    const Constraints &constraints = body_constraints.all();
    responses[k] = {};
    std::map<std::size_t, std::vector<double>> loads;
    for (const BodyConstraints::Entry &entry : body_constraints[k])
      for (const auto &[column, z] : Z[constraints.number(entry.constraint)])
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
          responses[k].add(constraints.number(entry.constraint), column, entry.form.dot(load));
    }
  }

  void CoarseSpace::factor()
  {
    if (n_columns == 0)
      return;
    SymmetricEntries entries;
    std::vector<double> diagonal(n_columns, 0.);
    for (std::size_t i = 0; i < FZ.size(); ++i)
      for (const auto &[column, value] : FZ[i])
        for (const auto &[k, z] : Z[i])
          if (k <= column)
          {
            entries.add(column, k, z * value);
            if (k == column)
              diagonal[k] += z * value;
          }
    for (std::size_t k = 0; k < n_columns; ++k)
      // Rigid body modes of a group without active rows would make E singular and the columns of Z
      // dependent; their part in Z E^-1 Z^T is zero.
      entries.add(k, k, diagonal[k] > 0. ? dependence_shift * diagonal[k] : 1.);
    entries.compress();
    E.factor(n_columns, entries, 0.);
  }

  namespace
  {
    using CoarseRow = std::vector<std::pair<std::size_t, double>>;

    /// A^T x of all ranks for a matrix by rows, of which x has the owned ones.
    void transposed_product(const RowMap &rows, const std::vector<CoarseRow> &A,
                            const std::vector<double> &x, std::vector<double> &result)
    {
      std::fill(result.begin(), result.end(), 0.);
      for (std::size_t p = 0; p < x.size(); ++p)
        for (const auto &[k, a] : A[rows.owned()[p]])
          result[k] += a * x[p];
      rows.communicator().sum(result);
    }

    /// Adds factor * A y on owned rows.
    void add_product(const RowMap &rows, const std::vector<CoarseRow> &A, const double factor,
                     const std::vector<double> &y, std::vector<double> &x)
    {
      for (std::size_t p = 0; p < x.size(); ++p)
        for (const auto &[k, a] : A[rows.owned()[p]])
          x[p] += factor * a * y[k];
    }
  } // namespace

  void CoarseSpace::solve(const RowMap &rows, const std::vector<double> &r, std::vector<double> &x,
                          std::vector<double> &Fx) const
  {
    x.assign(r.size(), 0.);
    Fx.assign(r.size(), 0.);
    if (n_columns == 0)
      return;
    amplitude.resize(n_columns);
    transposed_product(rows, Z, r, amplitude);
    E.solve(amplitude);
    add_product(rows, Z, 1., amplitude, x);
    add_product(rows, FZ, 1., amplitude, Fx);
  }

  void CoarseSpace::project(const RowMap &rows, std::vector<double> &z) const
  {
    if (n_columns == 0)
      return;
    amplitude.resize(n_columns);
    transposed_product(rows, FZ, z, amplitude);
    E.solve(amplitude);
    add_product(rows, Z, -1., amplitude, z);
  }
} // namespace taut
