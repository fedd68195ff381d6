// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/interface/row_map.h>

#include <Epetra_MpiComm.h>
#include <Epetra_SerialComm.h>
#include <Epetra_Util.h>

#include <algorithm>
#include <utility>

namespace taut
{
  namespace
  {
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
    set_held_map();
    if (processes.size() == 1)
      owned_map = std::make_shared<const Epetra_Map>(*held_map);
    else
      owned_map = std::make_shared<const Epetra_Map>(Epetra_Util::Create_OneToOne_Map(*held_map));
    for (int i = 0; i < owned_map->NumMyElements(); ++i)
      own.push_back(owned_map->GID(i));
    plan();
  }

  RowMap::RowMap(const RowMap &owners, std::vector<std::size_t> held)
      : processes(owners.processes), n(owners.n), rows(std::move(held)), own(owners.own),
        epetra(owners.epetra), owned_map(owners.owned_map)
  {
    set_held_map();
    plan();
  }

  void RowMap::set_held_map()
  {
    const std::vector<int> numbers(rows.begin(), rows.end());
    held_map = std::make_unique<const Epetra_Map>(-1, static_cast<int>(numbers.size()),
                                                  numbers.data(), 0, *epetra);
  }

  void RowMap::plan()
  {
    importer = std::make_unique<const Epetra_Import>(*held_map, *owned_map);
    held_work = std::make_unique<Epetra_Vector>(*held_map);
    owned_work = std::make_unique<Epetra_Vector>(*owned_map);
  }

  void RowMap::copy_to_holders(const double *values, double *on_held) const
  {
    std::copy_n(values, own.size(), owned_work->Values());
    held_work->Import(*owned_work, *importer, Insert);
    std::copy_n(held_work->Values(), rows.size(), on_held);
  }

  void RowMap::add_shares(const double *on_held, double *sums) const
  {
    std::copy_n(on_held, rows.size(), held_work->Values());
    owned_work->PutScalar(0.);
    owned_work->Export(*held_work, *importer, Add);
    std::copy_n(owned_work->Values(), own.size(), sums);
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
