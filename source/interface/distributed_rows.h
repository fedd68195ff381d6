// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_distributed_rows_h
#define taut_distributed_rows_h

#include "complementarity/shared_rows.h"
#include <taut/interface/row_map.h>

#include <initializer_list>
#include <vector>

namespace taut
{
  /// Each entry of several vectors becomes its sum over all ranks, by one message. Called by all
  /// ranks together, with vectors of the same lengths.
  void sum_together(const Communicator &processes,
                    std::initializer_list<std::vector<double> *> vectors);

  /// Rows on the ranks of their bodies, and then rows that all ranks have. The root owns these.
  class DistributedRows : public SharedRows
  {
  public:
    /// @p of_bodies are the numbers of those of this rank, ascending, of @p n_of_bodies of all
    /// ranks, each of which a rank has. Called by all ranks together.
    DistributedRows(const Communicator &processes, std::vector<std::size_t> of_bodies,
                    std::size_t n_of_bodies, std::size_t n_common);

    /// The same with another number of common rows.
    DistributedRows(const DistributedRows &others, std::size_t n_common);

    std::size_t n_of_all() const override { return n_of_bodies + n_common; }
    std::size_t size() const override { return of_bodies.held().size() + n_common; }
    std::size_t number(std::size_t i) const override;
    std::size_t index(std::size_t number) const override;
    bool is_own(std::size_t i) const override;
    double max(double value) const override;
    void max(std::vector<double> &values) const override;
    void sum(std::vector<double> &values) const override;
    void sum_rows(std::initializer_list<std::vector<double> *> vectors) const override;
    void sum_entries(MatrixEntries &entries, std::size_t n_columns) const override;

  private:
    std::size_t n_of_bodies, n_common;
    RowMap of_bodies;
    std::vector<char> owns;
    mutable std::vector<double> owned, common;
  };
} // namespace taut

#endif
