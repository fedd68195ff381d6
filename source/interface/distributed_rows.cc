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
                                   const std::size_t n_of_bodies, const std::size_t n_common)
      : n_of_bodies(n_of_bodies), n_common(n_common),
        of_bodies(processes, std::move(own), n_of_bodies), owns(of_bodies.held().size(), 0),
        owned(of_bodies.owned().size())
  {
    for (const std::size_t number : of_bodies.owned())
      owns[index(number)] = 1;
  }

  DistributedRows::DistributedRows(const DistributedRows &others, const std::size_t n_common)
      : DistributedRows(others)
  {
    this->n_common = n_common;
  }

  std::size_t DistributedRows::number(const std::size_t i) const
  {
    const std::size_t n_held = of_bodies.held().size();
    return i < n_held ? of_bodies.held()[i] : n_of_bodies + i - n_held;
  }

  std::size_t DistributedRows::index(const std::size_t number) const
  {
    const std::vector<std::size_t> &held = of_bodies.held();
    if (number >= n_of_all())
      return elsewhere;
    if (number >= n_of_bodies)
      return held.size() + number - n_of_bodies;
    const auto at = std::lower_bound(held.begin(), held.end(), number);
    return at != held.end() && *at == number ? at - held.begin() : elsewhere;
  }

  bool DistributedRows::is_own(const std::size_t i) const
  {
    return i < owns.size() ? owns[i] : of_bodies.communicator().is_root();
  }

  double DistributedRows::max(const double value) const
  {
    return of_bodies.communicator().max(value);
  }

  void DistributedRows::max(std::vector<double> &values) const
  {
    of_bodies.communicator().max(values);
  }

  void DistributedRows::sum(std::vector<double> &values) const
  {
    of_bodies.communicator().sum(values);
  }

  void DistributedRows::sum_rows(const std::initializer_list<std::vector<double> *> vectors) const
  {
    const std::size_t n_held = owns.size();
    common.clear();
    for (std::vector<double> *const v : vectors)
    {
      of_bodies.add_shares(v->data(), owned.data());
      of_bodies.copy_to_holders(owned.data(), v->data());
      common.insert(common.end(), v->begin() + n_held, v->end());
    }
    if (n_common == 0)
      return;
    of_bodies.communicator().sum(common);
    auto sums = common.begin();
    for (std::vector<double> *const v : vectors)
    {
      std::copy(sums, sums + n_common, v->begin() + n_held);
      sums += n_common;
    }
  }

  void DistributedRows::sum_entries(MatrixEntries &entries, const std::size_t n_columns) const
  {
    MatrixEntries on_some, of_common;
    for (std::size_t e = 0; e < entries.size(); ++e)
      (static_cast<std::size_t>(entries.row[e]) < n_of_bodies ? on_some : of_common)
          .add(entries.row[e], entries.column[e], entries.value[e]);
    of_bodies.sum_entries(on_some, n_columns);
    entries = std::move(on_some);
    if (n_common == 0)
      return;
    of_common.compress();
    taut::gather(of_bodies.communicator(), of_common);
    of_common.compress();
    for (std::size_t e = 0; e < of_common.size(); ++e)
      entries.add(of_common.row[e], of_common.column[e], of_common.value[e]);
  }
} // namespace taut
