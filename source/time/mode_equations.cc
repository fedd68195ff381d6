// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/gather_entries.h>
#include <taut/time/mode_equations.h>

#include <numeric>

namespace taut
{
  std::size_t set_mode_equations(const ModeVectors &vectors, const Communicator &processes,
                                 const Constraints &constraints, const BodyVectors &P,
                                 MixedComplementarityProblem &problem)
  {
    std::size_t n_own = 0;
    for (const auto *own_vectors : vectors)
      n_own += own_vectors->size();
    const std::vector<std::size_t> n_null_space = processes.gather(n_own);
    const auto own = n_null_space.begin() + processes.rank();
    const std::size_t first = std::accumulate(n_null_space.begin(), own, std::size_t(0)),
                      n_all = std::accumulate(own, n_null_space.end(), first);
    problem.null_space.assign(n_all, {});
    problem.null_space_load.assign(n_all, 0.);

    std::vector<std::size_t> first_of_body;
    std::size_t next = first;
    for (std::size_t k = 0; k < vectors.size(); ++k)
    {
      first_of_body.push_back(next);
      for (const std::vector<double> &R : *vectors[k])
        problem.null_space_load[next++] = std::inner_product(R.begin(), R.end(), P[k].begin(), 0.);
    }
    MatrixEntries G;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const auto &[k, form] : constraints[i].terms)
        for (std::size_t v = 0; v < vectors[k]->size(); ++v)
          G.add(first_of_body[k] + v, i, form.dot((*vectors[k])[v]));
    gather(processes, G);
    G.compress();
    for (std::size_t e = 0; e < G.size(); ++e)
      if (G.value[e] != 0.)
        problem.null_space[G.row[e]].add(G.column[e], G.value[e]);
    processes.sum(problem.null_space_load);
    return first;
  }
} // namespace taut
