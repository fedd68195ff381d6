// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_symmetric_matrix_h
#define taut_symmetric_matrix_h

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

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

    /// DoFs that stand together at one node and couple only to those of the two neighbours; 0: no
    /// such structure.
    virtual unsigned int block_size() const = 0;

    /// Adds @p value to the entry (i, j) and, if i != j, to (j, i): call it once a pair.
    virtual void add(unsigned int i, unsigned int j, double value) = 0;

    /// y += factor * (this) x; vectors of length size().
    virtual void vmult_add(double factor, const double *x, double *y) const = 0;

    /// y = (this) x.
    virtual void vmult(const double *x, double *y) const = 0;

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

  /// Any pattern, entry by entry: the matrices of small lumped mechanisms.
  class CoordinateMatrix : public SymmetricMatrix
  {
  public:
    explicit CoordinateMatrix(unsigned int n) : n(n) {}

    using SymmetricMatrix::add;
    unsigned int size() const override { return n; }
    unsigned int block_size() const override { return 0; }
    void add(unsigned int i, unsigned int j, double value) override;
    void vmult_add(double factor, const double *x, double *y) const override;
    void vmult(const double *x, double *y) const override;
    void visit(const Visitor &visitor) const override;
    std::unique_ptr<SymmetricMatrix> clone() const override;

  private:
    unsigned int n;
    std::map<std::pair<unsigned int, unsigned int>, double> entries;
  };

  /**
   * Blocks of b x b on the diagonal and beside it: the matrices of a wire, b DoFs a node. Each of
   * the b^2 positions in a block has its own array over the nodes, so that products run over many
   * nodes at once.
   */
  template <int b>
  class BlockTridiagonalMatrix : public SymmetricMatrix
  {
  public:
    /// @p n is a multiple of b.
    explicit BlockTridiagonalMatrix(unsigned int n);

    using SymmetricMatrix::add;
    unsigned int size() const override { return b * n_nodes; }
    unsigned int block_size() const override { return b; }
    void add(unsigned int i, unsigned int j, double value) override;
    void vmult_add(double factor, const double *x, double *y) const override;
    void vmult(const double *x, double *y) const override;
    void visit(const Visitor &visitor) const override;
    std::unique_ptr<SymmetricMatrix> clone() const override;

  private:
    template <typename Result>
    void product(const double *x, double *y, const Result &result) const;

    std::size_t n_nodes;
    std::array<std::vector<double>, b * b> diagonal; ///< block (i, i)
    std::array<std::vector<double>, b * b>
        left; ///< block (i, i - 1); one node more, zero at both ends
  };

  /// A zero block-tridiagonal matrix with @p n rows in blocks of @p block_size, 1 to 4.
  std::unique_ptr<SymmetricMatrix> make_block_tridiagonal(unsigned int block_size, unsigned int n);
} // namespace taut

#endif
