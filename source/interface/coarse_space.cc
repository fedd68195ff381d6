// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/coarse_space.h"

#include "base/pivots.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace taut
{
  CoarseSpace::CoarseSpace(const FactoredStructure &solvers,
                           const BodyConstraints &body_constraints,
                           const std::size_t largest_whole_factor)
      : solvers(solvers), body_constraints(body_constraints), responses(body_constraints.size()),
        E(solvers.structure().communicator(), largest_whole_factor)
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

  void CoarseSpace::setup(const RowMap &rows, const std::vector<char> &active,
                          const std::vector<char> &is_changed,
                          const std::vector<double> &compliance)
  {
    const Constraints &constraints = body_constraints.all();
    position.assign(constraints.size(), no_link);
    for (std::size_t p = 0; p < rows.held().size(); ++p)
      if (const std::size_t i = constraints.index(rows.held()[p]); i < position.size())
        position[i] = p;
    set_columns(rows, active);
    rows.communicator().agree(
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
    for (std::size_t p = 0; p < rows.owned().size(); ++p)
      if (const double S = compliance[constraints.index(rows.owned()[p])]; S > 0.)
        for (const auto &[k, z] : Z[rows.position_of_owned(p)])
          entries.add(rows.owned()[p], k, S * z);
    set_rows(rows, entries, FZ);
    factor(rows);
  }

  void CoarseSpace::set_columns(const RowMap &rows, const std::vector<char> &active)
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
    set_rows(rows, entries, Z);
  }

  /// Sums the entries over the ranks, by the positions of held rows.
  void CoarseSpace::set_rows(const RowMap &rows, MatrixEntries &entries,
                             std::vector<Row> &result) const
  {
    rows.sum_entries(entries, n_columns);
    result.assign(rows.held().size(), {});
    std::size_t p = 0;
    for (std::size_t e = 0; e < entries.size(); ++e)
    {
      while (rows.held()[p] != static_cast<std::size_t>(entries.row[e]))
        ++p;
      result[p].emplace_back(entries.column[e], entries.value[e]);
    }
  }

  /// Adds responses of a body to its own columns and those of its neighbours.
  void CoarseSpace::add_responses(const std::size_t k, const std::vector<char> &active)
  {
    responses[k] = {};
    std::map<std::size_t, std::vector<double>> loads;
    for (const BodyConstraints::Entry &entry : body_constraints[k])
      for (const auto &[column, z] : Z[position[entry.constraint]])
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
          responses[k].add(body_constraints.all().number(entry.constraint), column,
                           entry.form.dot(load));
    }
  }

  /// Each rank adds the products of the rows that it owns.
  void CoarseSpace::factor(const RowMap &rows)
  {
    if (n_columns == 0)
      return;
    SymmetricEntries entries;
    for (std::size_t p = 0; p < rows.owned().size(); ++p)
    {
      const std::size_t i = rows.position_of_owned(p);
      for (const auto &[column, value] : FZ[i])
        for (const auto &[k, z] : Z[i])
          if (k <= column)
            entries.add(column, k, z * value);
    }
    std::vector<double> diagonal(n_columns, 0.);
    for (std::size_t e = 0; e < entries.size(); ++e)
      if (entries.row[e] == entries.column[e])
        diagonal[entries.row[e]] += entries.value[e];
    rows.communicator().sum(diagonal);
    for (std::size_t k = 0; rows.communicator().is_root() && k < n_columns; ++k)
      // Rigid body modes of a group without active rows would make E singular and the columns of Z
      // dependent; their part in Z E^-1 Z^T is zero.
      entries.add(k, k, diagonal[k] > 0. ? dependence_shift * diagonal[k] : 1.);
    entries.compress();
    E.factor(E.even_share(n_columns), std::move(entries), 0.);
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
        for (const auto &[k, a] : A[rows.position_of_owned(p)])
          result[k] += a * x[p];
      rows.communicator().sum(result);
    }

    /// Adds factor * A y on owned rows.
    void add_product(const RowMap &rows, const std::vector<CoarseRow> &A, const double factor,
                     const std::vector<double> &y, std::vector<double> &x)
    {
      for (std::size_t p = 0; p < x.size(); ++p)
        for (const auto &[k, a] : A[rows.position_of_owned(p)])
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
