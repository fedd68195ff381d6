// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/natural_coarse_problem.h"
#include "base/pivots.h"

#include <algorithm>
#include <utility>

namespace taut
{
  std::vector<double> NaturalCoarseProblem::products(const std::vector<LinearForm> &forms,
                                                     const std::vector<double> &x) const
  {
    std::vector<double> result(forms.size());
    for (std::size_t k = 0; k < forms.size(); ++k)
      result[k] = forms[k].dot(x);
    rows.communicator().sum(result);
    return result;
  }

  NaturalCoarseProblem::NaturalCoarseProblem(
      const std::vector<LinearForm> &null_space, const std::vector<double> &scale,
      const std::vector<char> &active, const RowMap &rows,
      const std::function<void(std::vector<double> &)> &solve)
      : rows(rows), G(null_space.size()), scaled_G(null_space.size())
  {
    // Motions at each row, so that only motions with common rows are multiplied.
    std::vector<std::vector<std::pair<std::size_t, double>>> at_row(active.size());
    std::vector<double> row(active.size(), 0.);
    for (std::size_t k = 0; k < null_space.size(); ++k)
    {
      for (std::size_t e = 0; e < null_space[k].index.size(); ++e)
      {
        const unsigned int i = null_space[k].index[e];
        if (active[i])
          G[k].add(i, null_space[k].value[e] * scale[i]);
      }
      row.assign(active.size(), 0.);
      G[k].add_to(1., row);
      solve(row);
      for (std::size_t i = 0; i < row.size(); ++i)
        if (row[i] != 0.)
        {
          scaled_G[k].add(i, row[i]);
          at_row[i].emplace_back(k, row[i]);
        }
    }
    SymmetricEntries entries;
    for (std::size_t k = 0; k < G.size(); ++k)
    {
      entries.add(k, k, 0.);
      for (std::size_t e = 0; e < G[k].index.size(); ++e)
        for (const auto &[other, value] : at_row[G[k].index[e]])
          if (other <= k)
            entries.add(k, other, G[k].value[e] * value);
    }
    entries.compress();
    is_definite = squares.factor(G.size(), entries, dependent_pivot) == G.size();

    const std::vector<std::size_t> &owned = rows.owned();
    for (std::vector<LinearForm> *forms : {&G, &scaled_G})
      for (LinearForm &form : *forms)
      {
        LinearForm of_owned;
        for (std::size_t e = 0; e < form.index.size(); ++e)
          if (const auto at = std::lower_bound(owned.begin(), owned.end(), form.index[e]);
              at != owned.end() && *at == form.index[e])
            of_owned.add(at - owned.begin(), form.value[e]);
        form = of_owned;
      }
  }

  void NaturalCoarseProblem::balance(const std::vector<double> &e, std::vector<double> &x) const
  {
    std::vector<double> amplitude = e;
    squares.solve(amplitude);
    for (std::size_t k = 0; k < G.size(); ++k)
      scaled_G[k].add_to(amplitude[k], x);
  }

  void NaturalCoarseProblem::project(std::vector<double> &x) const
  {
    std::vector<double> excess = products(G, x);
    for (double &e : excess)
      e = -e;
    balance(excess, x);
  }

  void NaturalCoarseProblem::project_residual(std::vector<double> &r) const
  {
    const std::vector<double> amplitude = amplitudes(r);
    for (std::size_t k = 0; k < G.size(); ++k)
      G[k].add_to(-amplitude[k], r);
  }

  std::vector<double> NaturalCoarseProblem::amplitudes(const std::vector<double> &r) const
  {
    std::vector<double> result = products(scaled_G, r);
    squares.solve(result);
    return result;
  }
} // namespace taut
