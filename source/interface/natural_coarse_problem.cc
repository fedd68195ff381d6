// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/natural_coarse_problem.h"
#include "base/gather_entries.h"
#include "base/pivots.h"

#include <limits>
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
      const std::vector<std::size_t> &rows_of_blocks,
      const std::function<void(std::vector<double> &)> &solve)
      : rows(rows), G(null_space.size()), scaled_G(null_space.size())
  {
    constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> position(active.size(), nowhere), number(active.size(), nowhere);
    for (std::size_t p = 0; p < rows_of_blocks.size(); ++p)
      position[rows_of_blocks[p]] = p;
    for (std::size_t p = 0; p < rows.owned().size(); ++p)
      number[rows.owned()[p]] = p;
    // Motions at each owned row, so that only motions with common rows are multiplied.
    std::vector<std::vector<std::pair<std::size_t, double>>> at_row(rows.owned().size());
    std::vector<double> values;
    for (std::size_t k = 0; k < null_space.size(); ++k)
    {
      bool is_seen = false;
      values.assign(rows_of_blocks.size(), 0.);
      for (std::size_t e = 0; e < null_space[k].index.size(); ++e)
      {
        const unsigned int i = null_space[k].index[e];
        if (!active[i] || position[i] == nowhere)
          continue;
        const double value = null_space[k].value[e] * scale[i];
        values[position[i]] += value;
        is_seen = true;
        if (number[i] != nowhere)
          G[k].add(number[i], value);
      }
      if (!is_seen)
        continue;
      solve(values);
      for (std::size_t p = 0; p < at_row.size(); ++p)
        if (const double value = values[position[rows.owned()[p]]]; value != 0.)
        {
          scaled_G[k].add(p, value);
          at_row[p].emplace_back(k, value);
        }
    }
    SymmetricEntries entries;
    for (std::size_t k = 0; k < G.size(); ++k)
    {
      if (rows.communicator().is_root())
        entries.add(k, k, 0.);
      for (std::size_t e = 0; e < G[k].index.size(); ++e)
        for (const auto &[other, value] : at_row[G[k].index[e]])
          if (other <= k)
            entries.add(k, other, G[k].value[e] * value);
    }
    entries.compress();
    gather(rows.communicator(), entries);
    entries.compress();
    is_definite = squares.factor(G.size(), entries, dependent_pivot) == G.size();
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
