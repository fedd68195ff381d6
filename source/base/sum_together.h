// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sum_together_h
#define taut_sum_together_h

#include <taut/base/communicator.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace taut
{
  /// Each entry of several vectors becomes its sum over all ranks, by one message. Called by all
  /// ranks together, with vectors of the same lengths.
  inline void sum_together(const Communicator &processes,
                           const std::initializer_list<std::vector<double> *> vectors)
  {
    if (processes.size() == 1)
      return;
    std::vector<double> all;
    for (const std::vector<double> *v : vectors)
      all.insert(all.end(), v->begin(), v->end());
    processes.sum(all);
    const double *sums = all.data();
    for (std::vector<double> *v : vectors)
    {
      std::copy(sums, sums + v->size(), v->begin());
      sums += v->size();
    }
  }
} // namespace taut

#endif
