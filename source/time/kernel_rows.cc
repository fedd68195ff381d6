// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/gather_entries.h>
#include <taut/time/kernel_rows.h>

#include <numeric>

namespace taut
{
  std::size_t set_kernel_rows(const KernelVectors &vectors, const Communicator &processes,
                              const ContactRows &rows, const BlockVector &P,
                              MixedComplementarityProblem &problem)
  {
    std::size_t n_own = 0;
    for (const auto *own_vectors : vectors)
      n_own += own_vectors->size();
    const std::vector<std::size_t> n_kernel = processes.gather(n_own);
    const auto own = n_kernel.begin() + processes.rank();
    const std::size_t first = std::accumulate(n_kernel.begin(), own, std::size_t(0)),
                      n_all = std::accumulate(own, n_kernel.end(), first);
    problem.kernel.assign(n_all, {});
    problem.kernel_load.assign(n_all, 0.);

    std::vector<std::size_t> first_of_body;
    std::size_t next = first;
    for (std::size_t k = 0; k < vectors.size(); ++k)
    {
      first_of_body.push_back(next);
      for (const std::vector<double> &R : *vectors[k])
        problem.kernel_load[next++] = std::inner_product(R.begin(), R.end(), P[k].begin(), 0.);
    }
    MatrixEntries G;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const auto &[k, form] : rows[i].terms)
        for (std::size_t v = 0; v < vectors[k]->size(); ++v)
          G.add(first_of_body[k] + v, i, form.dot((*vectors[k])[v]));
    gather(processes, G);
    G.compress();
    for (std::size_t e = 0; e < G.size(); ++e)
      if (G.value[e] != 0.)
        problem.kernel[G.row[e]].add(G.column[e], G.value[e]);
    processes.sum(problem.kernel_load);
    return first;
  }
} // namespace taut
