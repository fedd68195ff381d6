// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/distributed_rows.h"
#include "base/gather_entries.h"

#include <algorithm>
#include <utility>

namespace taut
{
  void sum_together(const Communicator &processes,
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

  DistributedRows::DistributedRows(const Communicator &processes, std::vector<std::size_t> own,
                                   const std::size_t n_cuts, const std::size_t n_common)
      : n_cuts(n_cuts), n_common(n_common), cuts(processes, std::move(own), n_cuts),
        is_own_cut(cuts.held().size(), 0), owned(cuts.owned().size())
  {
    for (const std::size_t number : cuts.owned())
      is_own_cut[index(number)] = 1;
  }

  std::size_t DistributedRows::number(const std::size_t i) const
  {
    const std::size_t n_held = cuts.held().size();
    return i < n_held ? cuts.held()[i] : n_cuts + i - n_held;
  }

  std::size_t DistributedRows::index(const std::size_t number) const
  {
    const std::vector<std::size_t> &held = cuts.held();
    if (number >= n_cuts)
      return held.size() + number - n_cuts;
    const auto at = std::lower_bound(held.begin(), held.end(), number);
    return at != held.end() && *at == number ? at - held.begin() : elsewhere;
  }

  bool DistributedRows::is_own(const std::size_t i) const
  {
    return i < is_own_cut.size() ? is_own_cut[i] : cuts.communicator().is_root();
  }

  double DistributedRows::max(const double value) const
  {
    return cuts.communicator().max(value);
  }

  void DistributedRows::max(std::vector<double> &values) const
  {
    cuts.communicator().max(values);
  }

  void DistributedRows::sum(std::vector<double> &values) const
  {
    cuts.communicator().sum(values);
  }

  void DistributedRows::sum_rows(const std::initializer_list<std::vector<double> *> vectors) const
  {
    const std::size_t n_held = is_own_cut.size();
    common.clear();
    for (std::vector<double> *const v : vectors)
    {
      cuts.add_shares(v->data(), owned.data());
      cuts.copy_to_holders(owned.data(), v->data());
      common.insert(common.end(), v->begin() + n_held, v->end());
    }
    cuts.communicator().sum(common);
    auto sums = common.begin();
    for (std::vector<double> *const v : vectors)
    {
      std::copy(sums, sums + n_common, v->begin() + n_held);
      sums += n_common;
    }
  }

  void DistributedRows::sum_entries(MatrixEntries &entries, const std::size_t n_columns) const
  {
    MatrixEntries of_cuts, of_common;
    for (std::size_t e = 0; e < entries.size(); ++e)
      (static_cast<std::size_t>(entries.row[e]) < n_cuts ? of_cuts : of_common)
          .add(entries.row[e], entries.column[e], entries.value[e]);
    cuts.sum_entries(of_cuts, n_columns);
    of_common.compress();
    taut::gather(cuts.communicator(), of_common);
    of_common.compress();
    entries = std::move(of_cuts);
    for (std::size_t e = 0; e < of_common.size(); ++e)
      entries.add(of_common.row[e], of_common.column[e], of_common.value[e]);
  }
} // namespace taut
