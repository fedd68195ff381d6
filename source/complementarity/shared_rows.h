// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_shared_rows_h
#define taut_shared_rows_h

#include <taut/base/sparse_cholesky.h>

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace taut
{
  /**
   * The rows of a problem of which each rank has some, as those who make one number of all rows see
   * them. Rows have an index on the rank, and a number among those of all ranks. Several ranks may
   * have a row, with the same values; one of them owns it. All functions that take values are
   * called by all ranks together.
   */
  class SharedRows
  {
  public:
    virtual ~SharedRows() = default;

    /// Index of a row that this rank does not have.
    static constexpr std::size_t elsewhere = static_cast<std::size_t>(-1);

    /// Number of rows of all ranks, and of this one.
    virtual std::size_t n_of_all() const = 0;
    virtual std::size_t size() const = 0;

    /// The number of a row of this rank, ascending with the index; and back.
    virtual std::size_t number(std::size_t i) const = 0;
    virtual std::size_t index(std::size_t number) const = 0;

    virtual bool is_own(std::size_t i) const = 0;

    /// The largest value of all ranks, not-a-number if one is; and for each entry of vectors of one
    /// length on all ranks.
    virtual double max(double value) const = 0;
    virtual void max(std::vector<double> &values) const = 0;

    /// Sums over the ranks of each entry of vectors of one length on all ranks.
    virtual void sum(std::vector<double> &values) const = 0;

    /// Each entry of vectors over the rows becomes the sum of what the ranks that have the row have
    /// there.
    virtual void sum_rows(std::initializer_list<std::vector<double> *> vectors) const = 0;

    /// Each rank has shares of the entries of a matrix in its rows, by the numbers of the rows, and
    /// gets the sums over the ranks, ordered by rows and columns.
    virtual void sum_entries(MatrixEntries &entries, std::size_t n_columns) const = 0;

    /// The values of all rows by their numbers, from those of a vector over the rows; and back.
    void gather(const std::vector<double> &values, std::vector<double> &all) const
    {
      all.assign(n_of_all(), 0.);
      for (std::size_t i = 0; i < size(); ++i)
        if (is_own(i))
          all[number(i)] = values[i];
      sum(all);
    }
    void pick(const std::vector<double> &all, std::vector<double> &values) const
    {
      values.resize(size());
      for (std::size_t i = 0; i < size(); ++i)
        values[i] = all[number(i)];
    }
  };
} // namespace taut

#endif
