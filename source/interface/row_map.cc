// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/interface/row_map.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Export.h>
#include <Epetra_Import.h>
#include <Epetra_MpiComm.h>
#include <Epetra_MpiDistributor.h>
#include <Epetra_SerialComm.h>
#include <Epetra_Util.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <utility>

namespace taut
{
  namespace
  {
    /// Of the messages between neighbours; Epetra's are above 24000, and those of Taut alone come
    /// in the order of their calls.
    constexpr int tag = 4800;

    /// AztecOO, where it knows MPI, takes nothing but a communicator of MPI.
    std::unique_ptr<Epetra_Comm> epetra_of(const Communicator &processes)
    {
      int is_on = 0;
      MPI_Initialized(&is_on);
      if (!is_on)
        return std::make_unique<Epetra_SerialComm>();
      return std::make_unique<Epetra_MpiComm>(processes.size() > 1 ? processes.of_mpi()
                                                                   : MPI_COMM_SELF);
    }
  } // namespace

  RowMap::RowMap(const Communicator &processes, std::vector<std::size_t> held,
                 const std::size_t n_rows)
      : processes(processes), n(n_rows), rows(std::move(held)), epetra(epetra_of(processes))
  {
    std::vector<double> n_holders(n, 0.);
    for (const std::size_t i : rows)
      n_holders[i] = 1.;
    processes.sum(n_holders);
    if (processes.is_root())
    {
      for (std::size_t i = 0; i < n; ++i)
        if (n_holders[i] == 0.)
          rows.push_back(i);
      std::sort(rows.begin(), rows.end());
    }
    const auto of_held = held_map();
    if (processes.size() == 1)
      owned_map = std::make_shared<const Epetra_Map>(*of_held);
    else
      owned_map = std::make_shared<const Epetra_Map>(Epetra_Util::Create_OneToOne_Map(*of_held));
    for (int i = 0; i < owned_map->NumMyElements(); ++i)
      own.push_back(owned_map->GID(i));
    plan(*of_held);
  }

  RowMap::RowMap(const RowMap &owners, std::vector<std::size_t> held)
      : processes(owners.processes), n(owners.n), rows(std::move(held)), own(owners.own),
        epetra(owners.epetra), owned_map(owners.owned_map)
  {
    if (!std::includes(rows.begin(), rows.end(), own.begin(), own.end()))
      throw std::invalid_argument("a rank does not hold all rows that it owns");
    plan(*held_map());
  }

  std::unique_ptr<const Epetra_Map> RowMap::held_map() const
  {
    const std::vector<int> numbers(rows.begin(), rows.end());
    return std::make_unique<const Epetra_Map>(-1, static_cast<int>(numbers.size()), numbers.data(),
                                              0, *epetra);
  }

  void RowMap::plan(const Epetra_Map &of_held)
  {
    for (const std::size_t i : own)
      own_held.push_back(of_held.LID(static_cast<int>(i)));
    if (processes.size() == 1)
      return;
    const Epetra_Import importer(of_held, *owned_map);
    std::map<int, Neighbour> by_rank;
    for (int e = 0; e < importer.NumExportIDs(); ++e)
      by_rank[importer.ExportPIDs()[e]].lent.push_back(importer.ExportLIDs()[e]);
    // The rows of others, in the order of their owners.
    const auto &from = dynamic_cast<const Epetra_MpiDistributor &>(importer.Distributor());
    const int *position = importer.RemoteLIDs();
    for (int r = 0; r < from.NumReceives(); ++r)
      for (int e = 0; e < from.LengthsFrom()[r]; ++e)
        by_rank[from.ProcsFrom()[r]].borrowed.push_back(*position++);
    for (auto &[rank, neighbour] : by_rank)
    {
      // Both sides then have their common rows in ascending order.
      std::sort(neighbour.lent.begin(), neighbour.lent.end());
      std::sort(neighbour.borrowed.begin(), neighbour.borrowed.end());
      neighbour.rank = rank;
      const std::size_t most = std::max(neighbour.lent.size(), neighbour.borrowed.size());
      neighbour.sent.resize(most);
      neighbour.received.resize(most);
      neighbours.push_back(std::move(neighbour));
    }
    messages.reserve(2 * neighbours.size());
  }

  void RowMap::receive(const Rows rows_of) const
  {
    messages.clear();
    for (const Neighbour &with : neighbours)
      if (const int size = static_cast<int>((with.*rows_of).size()); size > 0)
        MPI_Irecv(with.received.data(), size, MPI_DOUBLE, with.rank, tag, processes.of_mpi(),
                  &messages.emplace_back());
  }

  void RowMap::send(const double *const values, const Rows rows_of) const
  {
    for (const Neighbour &with : neighbours)
      if (const std::vector<int> &positions = with.*rows_of; !positions.empty())
      {
        for (std::size_t e = 0; e < positions.size(); ++e)
          with.sent[e] = values[positions[e]];
        MPI_Isend(with.sent.data(), static_cast<int>(positions.size()), MPI_DOUBLE, with.rank, tag,
                  processes.of_mpi(), &messages.emplace_back());
      }
  }

  void RowMap::wait() const
  {
    if (!messages.empty())
      MPI_Waitall(static_cast<int>(messages.size()), messages.data(), MPI_STATUSES_IGNORE);
  }

  void RowMap::copy_to_holders(const double *values, double *on_held) const
  {
    receive(&Neighbour::borrowed);
    send(values, &Neighbour::lent);
    for (std::size_t p = 0; p < own.size(); ++p)
      on_held[own_held[p]] = values[p];
    wait();
    for (const Neighbour &owner : neighbours)
      for (std::size_t e = 0; e < owner.borrowed.size(); ++e)
        on_held[owner.borrowed[e]] = owner.received[e];
  }

  /// The result on owned rows of what the ranks that hold a row have there.
  template <typename Combine>
  void RowMap::combine(const double *on_held, double *result, const Combine &with) const
  {
    receive(&Neighbour::lent);
    send(on_held, &Neighbour::borrowed);
    for (std::size_t p = 0; p < own.size(); ++p)
      result[p] = on_held[own_held[p]];
    wait();
    for (const Neighbour &holder : neighbours)
      for (std::size_t e = 0; e < holder.lent.size(); ++e)
        result[holder.lent[e]] = with(result[holder.lent[e]], holder.received[e]);
  }

  void RowMap::add_shares(const double *on_held, double *sums) const
  {
    combine(on_held, sums, std::plus<>());
  }

  void RowMap::take_smallest(std::vector<double> &on_held) const
  {
    std::vector<double> smallest(own.size());
    combine(on_held.data(), smallest.data(),
            [](const double a, const double b) { return std::min(a, b); });
    copy_to_holders(smallest.data(), on_held.data());
  }

  namespace
  {
    void check(const int error)
    {
      if (error < 0) // others are warnings
        throw std::runtime_error("entries of a matrix cannot be sent between ranks: error " +
                                 std::to_string(error) + " of Epetra");
    }
  } // namespace

  void RowMap::sum_entries(MatrixEntries &entries, const std::size_t n_columns) const
  {
    entries.compress();
    if (processes.size() == 1 || n_columns == 0)
      return;
    const auto of_held = held_map();
    const Epetra_Map columns(static_cast<int>(n_columns), 0, *epetra);
    Epetra_CrsMatrix shares(Copy, *of_held, 0), sums(Copy, *owned_map, 0),
        result(Copy, *of_held, 0);
    processes.agree(
        [&]
        {
          for (std::size_t e = 0, end = 0; e < entries.size(); e = end)
          {
            while (end < entries.size() && entries.row[end] == entries.row[e])
              ++end;
            check(shares.InsertGlobalValues(entries.row[e], static_cast<int>(end - e),
                                            &entries.value[e], &entries.column[e]));
          }
        });
    check(shares.FillComplete(columns, *owned_map));
    check(sums.Export(shares, Epetra_Export(*of_held, *owned_map), Add));
    check(sums.FillComplete(columns, *owned_map));
    check(result.Import(sums, Epetra_Import(*of_held, *owned_map), Insert));
    entries = {};
    for (const std::size_t row : rows)
    {
      int n = 0, *column = nullptr;
      double *value = nullptr;
      check(result.ExtractGlobalRowView(static_cast<int>(row), n, value, column));
      for (int e = 0; e < n; ++e)
        entries.add(row, column[e], value[e]);
    }
    entries.compress();
  }

  void RowMap::gather(const std::vector<double> &values, std::vector<double> &all) const
  {
    all.assign(n, 0.);
    for (std::size_t i = 0; i < own.size(); ++i)
      all[own[i]] = values[i];
    processes.sum(all);
  }

  void RowMap::pick(const std::vector<double> &all, std::vector<double> &values) const
  {
    values.resize(own.size());
    for (std::size_t i = 0; i < own.size(); ++i)
      values[i] = all[own[i]];
  }
} // namespace taut
