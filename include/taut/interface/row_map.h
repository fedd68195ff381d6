// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_row_map_h
#define taut_row_map_h

#include <taut/base/communicator.h>
#include <taut/base/sparse_cholesky.h>

#include <Epetra_Comm.h>
#include <Epetra_Map.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace taut
{
  /**
   * Which rows of the constraints this rank holds, and which of them it owns. A rank holds the rows
   * with a term on one of its bodies. Each row has one owner, the first rank that holds it, or
   * rank 0 if none does. Vectors over owned rows are those of an Epetra_Map. The owner of a row and
   * the ranks that hold it send each other values and shares, by the plan of an Epetra_Import; a
   * rank waits for its neighbours alone, where Epetra's own import begins with a barrier. Messages
   * have the tag 4800 of the communicator.
   *
   * On one rank all rows are held and owned. All functions but the sizes are called by all ranks
   * together.
   */
  class RowMap
  {
  public:
    /// @p held: rows with a term on a body of this rank, ascending, of @p n_rows of all ranks.
    RowMap(const Communicator &processes, std::vector<std::size_t> held, std::size_t n_rows);

    /// The same owners, for a rank that holds other rows, ascending, those that it owns among them.
    RowMap(const RowMap &owners, std::vector<std::size_t> held);

    /// The owned rows, ascending.
    const std::vector<std::size_t> &owned() const { return own; }

    /// The rows that this rank holds, ascending: the owned ones among them.
    const std::vector<std::size_t> &held() const { return rows; }

    /// Of the owned rows, numbered as they are; each row on one rank.
    const Epetra_Map &map() const { return *owned_map; }

    /// Values on the held rows from those on owned rows.
    void copy_to_holders(const double *values, double *on_held) const;

    /// Sums over the ranks that hold a row, on the owned rows.
    void add_shares(const double *on_held, double *sums) const;

    /// Each value becomes the smallest value that a rank has for its row; on held rows.
    void take_smallest(std::vector<double> &on_held) const;

    /// Position of an owned row among the held ones.
    std::size_t position_of_owned(const std::size_t p) const { return own_held[p]; }

    /// Each rank has shares of the entries of a matrix in its held rows, by the numbers of the
    /// rows, and gets the sums over the ranks, ordered by rows and columns.
    void sum_entries(MatrixEntries &entries, std::size_t n_columns) const;

    /// Between owned rows, and all rows on all ranks.
    void gather(const std::vector<double> &values, std::vector<double> &all) const;
    void pick(const std::vector<double> &all, std::vector<double> &values) const;

    const Communicator &communicator() const { return processes; }

  private:
    /// What a rank and another one have in common.
    struct Neighbour
    {
      int rank;
      std::vector<int> lent;     ///< positions among the owned rows, which the other one holds
      std::vector<int> borrowed; ///< positions among the held rows, which the other one owns
      mutable std::vector<double> sent, received;
    };

    std::unique_ptr<const Epetra_Map> held_map() const;
    void plan(const Epetra_Map &of_held);
    using Rows = std::vector<int> Neighbour::*;
    void receive(Rows rows_of) const;
    void send(const double *values, Rows rows_of) const;
    void wait() const;
    template <typename Combine>
    void combine(const double *on_held, double *result, const Combine &with) const;

    const Communicator processes;
    std::size_t n;
    std::vector<std::size_t> rows, own;
    std::shared_ptr<const Epetra_Comm> epetra;
    std::shared_ptr<const Epetra_Map> owned_map;
    std::vector<int> own_held; ///< positions of the owned rows among the held ones
    std::vector<Neighbour> neighbours;
    mutable std::vector<MPI_Request> messages; ///< that are under way
  };
} // namespace taut

#endif
