// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/natural_coarse_problem.h"
#include "base/pivots.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace taut
{
  std::vector<double> NaturalCoarseProblem::products(const std::vector<LinearForm> &forms,
                                                     const std::vector<double> &x) const
  {
    std::vector<double> result(n_modes, 0.);
    for (std::size_t k = 0; k < forms.size(); ++k)
      result[mode[k]] = forms[k].dot(x);
    rows.communicator().sum(result);
    return result;
  }

  namespace
  {
    constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

    /// Sets of vectors of which no two have entries in one block. @p blocks are those of each
    /// vector.
    std::vector<std::vector<std::size_t>> apart(const std::vector<std::vector<std::size_t>> &blocks,
                                                const std::size_t n_blocks)
    {
      std::vector<std::vector<std::size_t>> result, sets_at(n_blocks);
      std::vector<std::size_t> last; // vector that meets a set
      for (std::size_t k = 0; k < blocks.size(); ++k)
      {
        if (blocks[k].empty())
          continue;
        for (const std::size_t b : blocks[k])
          for (const std::size_t set : sets_at[b])
            last[set] = k;
        const std::size_t own =
            std::find_if(last.begin(), last.end(), [k](const std::size_t v) { return v != k; }) -
            last.begin();
        if (own == last.size())
        {
          last.push_back(nowhere);
          result.emplace_back();
        }
        result[own].push_back(k);
        for (const std::size_t b : blocks[k])
          sets_at[b].push_back(own);
      }
      return result;
    }
  } // namespace

  NaturalCoarseProblem::NaturalCoarseProblem(
      const std::vector<LinearForm> &null_space, const std::vector<double> &scale,
      const std::vector<double> &active, const RowMap &rows, const RowBlocks &blocks,
      const std::function<void(std::vector<double> &)> &solve,
      const std::size_t largest_whole_factor)
      : rows(rows), n_modes(null_space.size()), squares(rows.communicator(), largest_whole_factor)
  {
    // Position of each row among the owned ones.
    std::vector<std::size_t> owned(blocks.rows.size(), nowhere);
    std::size_t n_owned = 0;
    for (std::size_t p = 0; p < owned.size() && n_owned < rows.owned().size(); ++p)
      if (blocks.rows[p] == rows.owned()[n_owned])
        owned[p] = n_owned++;
    std::vector<LinearForm> on_blocks;
    std::vector<std::vector<std::size_t>> met;
    for (std::size_t k = 0; k < n_modes; ++k)
    {
      if (null_space[k].index.empty())
        continue;
      mode.push_back(k);
      LinearForm &own_part = G.emplace_back(), &form = on_blocks.emplace_back();
      std::vector<std::size_t> &its_blocks = met.emplace_back();
      for (std::size_t e = 0; e < null_space[k].index.size(); ++e)
      {
        const unsigned int p = null_space[k].index[e];
        if (active[p] == 0.)
          continue;
        const double value = null_space[k].value[e] * scale[p];
        form.add(p, value);
        its_blocks.push_back(blocks.block[p]);
        if (owned[p] != nowhere)
          own_part.add(owned[p], value);
      }
      std::sort(its_blocks.begin(), its_blocks.end());
      its_blocks.erase(std::unique(its_blocks.begin(), its_blocks.end()), its_blocks.end());
    }
    scaled_G.resize(mode.size());
    std::vector<std::vector<std::size_t>> members(blocks.n_blocks());
    for (std::size_t p = 0; p < blocks.rows.size(); ++p)
      members[blocks.block[p]].push_back(p);
    std::vector<double> values;
    for (const std::vector<std::size_t> &set : apart(met, members.size()))
    {
      values.assign(blocks.rows.size(), 0.);
      for (const std::size_t k : set)
        on_blocks[k].add_to(1., values);
      solve(values);
      for (const std::size_t k : set)
      {
        std::vector<std::size_t> reached;
        for (const std::size_t b : met[k])
          reached.insert(reached.end(), members[b].begin(), members[b].end());
        std::sort(reached.begin(), reached.end());
        for (const std::size_t p : reached)
          if (const std::size_t own = owned[p]; own != nowhere && values[p] != 0.)
            scaled_G[k].add(own, values[p]);
      }
    }
    // Motions at each owned row, so that only motions with common rows are multiplied.
    std::vector<std::vector<std::pair<std::size_t, double>>> at_row(rows.owned().size());
    for (std::size_t k = 0; k < scaled_G.size(); ++k)
      for (std::size_t e = 0; e < scaled_G[k].index.size(); ++e)
        at_row[scaled_G[k].index[e]].emplace_back(k, scaled_G[k].value[e]);
    SymmetricEntries entries;
    for (std::size_t k = 0; rows.communicator().is_root() && k < n_modes; ++k)
      entries.add(k, k, 0.);
    for (std::size_t k = 0; k < mode.size(); ++k)
      for (std::size_t e = 0; e < G[k].index.size(); ++e)
        for (const auto &[other, value] : at_row[G[k].index[e]])
          if (other <= k)
            entries.add(mode[k], mode[other], G[k].value[e] * value);
    entries.compress();
    is_definite = squares.factor(squares.even_share(n_modes), std::move(entries), dependent_pivot);
  }

  void NaturalCoarseProblem::balance(const std::vector<double> &e, std::vector<double> &x) const
  {
    std::vector<double> amplitude = e;
    squares.solve(amplitude);
    for (std::size_t k = 0; k < mode.size(); ++k)
      scaled_G[k].add_to(amplitude[mode[k]], x);
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
    for (std::size_t k = 0; k < mode.size(); ++k)
      G[k].add_to(-amplitude[mode[k]], r);
  }

  std::vector<double> NaturalCoarseProblem::amplitudes(const std::vector<double> &r) const
  {
    std::vector<double> result = products(scaled_G, r);
    squares.solve(result);
    return result;
  }
} // namespace taut
