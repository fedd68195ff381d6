// SPDX-License-Identifier: LGPL-2.1-or-later
#include "natural_coarse_problem.h"

#include <utility>

namespace taut
{
  namespace
  {
    /// Smallest pivot of G G^T of independent motions, relative to its diagonal entry.
    constexpr double smallest_pivot = 1e-12;
  } // namespace

  NaturalCoarseProblem::NaturalCoarseProblem(const std::vector<LinearForm> &null_space,
                                             const std::vector<double> &scale,
                                             const std::vector<char> &active)
      : G(null_space.size())
  {
    // The motions at each row, so that products are formed only between those that meet.
    std::vector<std::vector<std::pair<std::size_t, double>>> at_row(active.size());
    for (std::size_t k = 0; k < null_space.size(); ++k)
      for (std::size_t e = 0; e < null_space[k].index.size(); ++e)
      {
        const unsigned int i = null_space[k].index[e];
        if (!active[i])
          continue;
        G[k].add(i, null_space[k].value[e] * scale[i]);
        at_row[i].emplace_back(k, G[k].value.back());
      }
    SymmetricEntries entries;
    for (const auto &motions : at_row)
      for (std::size_t a = 0; a < motions.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b)
          entries.add(motions[a].first, motions[b].first, motions[a].second * motions[b].second);
    for (std::size_t k = 0; k < G.size(); ++k)
      entries.add(k, k, 0.);
    entries.compress();
    is_definite = squares.factor(G.size(), entries, smallest_pivot) == G.size();
  }

  void NaturalCoarseProblem::balance(const std::vector<double> &e, std::vector<double> &x) const
  {
    std::vector<double> amplitude = e;
    squares.solve(amplitude);
    for (std::size_t k = 0; k < G.size(); ++k)
      G[k].add_to(amplitude[k], x);
  }

  std::vector<double> NaturalCoarseProblem::unbalance(const std::vector<double> &x) const
  {
    std::vector<double> result(G.size());
    for (std::size_t k = 0; k < G.size(); ++k)
      result[k] = G[k].dot(x);
    return result;
  }

  void NaturalCoarseProblem::project(std::vector<double> &x) const
  {
    std::vector<double> amplitude = amplitudes(x);
    for (std::size_t k = 0; k < G.size(); ++k)
      G[k].add_to(-amplitude[k], x);
  }

  std::vector<double> NaturalCoarseProblem::amplitudes(const std::vector<double> &x) const
  {
    std::vector<double> result = unbalance(x);
    squares.solve(result);
    return result;
  }
} // namespace taut
