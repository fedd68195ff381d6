// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_patterned_cholesky_h
#define taut_patterned_cholesky_h

#include <taut/base/sparse_cholesky.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace taut
{
  /// The lower triangle of a sparse symmetric matrix whose values change more often than its
  /// pattern: row after row with ascending columns, and the diagonal apart.
  struct SparseTriangle
  {
    /// An entry beside the diagonal, as seen from one of its two rows.
    struct Neighbour
    {
      unsigned int row;  ///< the other row
      std::size_t entry; ///< index in `value`
    };

    std::vector<std::size_t> begin; ///< first entry of each row, and the end
    std::vector<unsigned int> column;
    std::vector<double> value;
    std::vector<double> diagonal;

    /// The entries of each row in both triangles.
    std::vector<std::size_t> neighbours_begin;
    std::vector<Neighbour> neighbours;

    std::size_t size() const { return diagonal.size(); }

    /// Pattern of @p entries in @p n rows, with zero values.
    void set_pattern(std::size_t n, SymmetricEntries entries);

    /// Sets the values; entries of one position add. Returns false, with zero values, if the
    /// pattern lacks a position. Allocates nothing.
    bool set_values(const SymmetricEntries &entries);
  };

  /// Order of elimination, elimination tree and pattern of the factor of a sparse symmetric matrix
  /// (T. A. Davis, Direct Methods for Sparse Linear Systems (2006), 4.1 and 4.3). Places count in
  /// the order of elimination.
  struct EliminationPattern
  {
    explicit EliminationPattern(const SparseTriangle &matrix);

    std::size_t size() const { return order.size(); }

    /// An entry in a row: its column as a place, and its index in an array of values.
    struct Entry
    {
      unsigned int column;
      std::size_t index;
    };

    std::vector<unsigned int> order;    ///< row at each place
    std::vector<unsigned int> position; ///< place of each row
    std::vector<unsigned int> parent;   ///< of each place; size(): a root

    /// Entries of the matrix in the row at each place before its diagonal.
    std::vector<std::size_t> sources_begin;
    std::vector<Entry> sources;

    /// The factor by columns: places below the diagonal, ascending.
    std::vector<std::size_t> column_begin;
    std::vector<unsigned int> row;

    /// The factor by rows, columns ascending; indices count in `row`.
    std::vector<std::size_t> entries_begin;
    std::vector<Entry> entries;

  private:
    void set_sources(const SparseTriangle &matrix);
    void set_tree();
    void set_factor();
  };

  /**
   * The factor L D L^T of the rows of a sparse matrix that are active, in a pattern of all rows.
   * Use it where rows become active and passive again and again. A row that changes has the rows on
   * its path to the root of the elimination tree factored again, with the same bits as if all were.
   * Nothing is allocated after reinit().
   */
  class PatternedCholesky
  {
  public:
    /// Forgets the factor.
    void reinit(std::shared_ptr<const EliminationPattern> pattern);

    /// Values of row i have changed.
    void changed(std::size_t i);

    /// Values of any rows have changed.
    void changed();

    /**
     * Makes this the factor of F + shift diag(F) on the rows that are not 0 in @p active. Other
     * rows have a unit diagonal alone. Returns false when a pivot falls below 1e-12 of its diagonal
     * entry; the rows before it remain factored for the next call.
     */
    bool factor(const SparseTriangle &matrix, const std::vector<char> &active, double shift);

    /// Number of factorisations that changed the factor.
    std::size_t version() const { return n_changes; }

    /// x = L^-1 x, of numbers by place.
    void solve_lower(std::vector<double> &x) const;

    /// The same if x is 0 but at the @p places, which become all where it is not, ascending.
    void solve_lower(std::vector<double> &x, std::vector<unsigned int> &places) const;

    /// x = L^-T x, of numbers by place.
    void solve_upper(std::vector<double> &x) const;

    /// 1 / D, by place.
    const std::vector<double> &inverse_pivots() const { return inverse; }

    const EliminationPattern &pattern() const { return *eliminated; }

  private:
    void invalidate(std::size_t place);
    bool eliminate(const SparseTriangle &matrix, std::size_t place);

    std::shared_ptr<const EliminationPattern> eliminated;
    std::vector<double> lower;    ///< L, by columns without the unit diagonal
    std::vector<double> inverse;  ///< 1 / D
    std::vector<char> is_active;  ///< of each row
    std::vector<char> is_invalid; ///< of each place; then those on the path to the root are, too
    std::size_t n_invalid = 0, n_changes = 0;
    double factored_shift = 0.;
    std::vector<double> work; ///< by place; 0 but within eliminate()
  };
} // namespace taut

#endif
