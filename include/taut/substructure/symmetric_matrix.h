// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_symmetric_matrix_h
#define taut_symmetric_matrix_h

#include <taut/base/sparse_cholesky.h>

#include <cstddef>
#include <functional>
#include <memory>

namespace taut
{
  /// A symmetric matrix of a substructure: mass, damping or stiffness.
  class SymmetricMatrix
  {
  public:
    /// Receives row i, column j <= i and the value.
    using Visitor = std::function<void(unsigned int, unsigned int, double)>;

    virtual ~SymmetricMatrix() = default;

    virtual unsigned int size() const = 0;

    /// Number of DoFs at a node, if they couple only with DoFs of the two neighbouring nodes; 0: no
    /// block structure.
    virtual unsigned int block_size() const = 0;

    /// Adds @p value to the entry (i, j) and, if i != j, to (j, i): call it once per pair.
    virtual void add(unsigned int i, unsigned int j, double value) = 0;

    /// Sets all entries to zero, and keeps their memory for the next ones.
    virtual void set_zero() = 0;

    /// Call it after the last add(): products then read repeated rows once. A later add() undoes
    /// it.
    virtual void find_repetitions() {}

    /// y += factor * (this) x; vectors of length size().
    virtual void vmult_add(double factor, const double *x, double *y) const = 0;

    /// y = (this) x.
    virtual void vmult(const double *x, double *y) const;

    /// Calls the visitor once for each stored pair (i, j <= i).
    virtual void visit(const Visitor &visitor) const = 0;

    virtual std::unique_ptr<SymmetricMatrix> clone() const = 0;

    /// this += factor * other, entry by entry.
    void add(double factor, const SymmetricMatrix &other)
    {
      other.visit(
          [&](unsigned int i, unsigned int j, double value)
          {
            if (value != 0.)
              add(i, j, factor * value);
          });
    }
  };

  /// Any pattern, as compressed rows of the lower triangle. Entries may be added in any order until
  /// the first use of another function, and again after it.
  class CompressedMatrix : public SymmetricMatrix
  {
  public:
    explicit CompressedMatrix(unsigned int n) : n(n) {}

    using SymmetricMatrix::add;
    unsigned int size() const override { return n; }
    unsigned int block_size() const override { return 0; }
    void add(unsigned int i, unsigned int j, double value) override;
    void set_zero() override;
    void find_repetitions() override { compress(); }
    void vmult_add(double factor, const double *x, double *y) const override;
    void visit(const Visitor &visitor) const override;
    std::unique_ptr<SymmetricMatrix> clone() const override;

  private:
    void compress() const;
    double *find(unsigned int i, unsigned int j);

    unsigned int n;
    mutable SymmetricEntries added;             ///< not yet in the rows
    mutable std::vector<std::size_t> begin_row; ///< empty: no entries yet
    mutable std::vector<unsigned int> column;
    mutable std::vector<double> value;
  };

  /// A zero block-tridiagonal matrix with @p n rows in blocks of @p block_size, 1 to 4 or 6: the
  /// matrices of a wire, its DoFs by nodes.
  std::unique_ptr<SymmetricMatrix> make_block_tridiagonal(unsigned int block_size, unsigned int n);
} // namespace taut

#endif
