// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sparse_cholesky_h
#define taut_sparse_cholesky_h

#include <taut/base/linear_form.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace taut
{
  /// Entries of a sparse matrix, in any order; entries of one position add.
  struct MatrixEntries
  {
    std::vector<int> row, column;
    std::vector<double> value;

    void add(std::size_t i, std::size_t j, double v)
    {
      row.push_back(static_cast<int>(i));
      column.push_back(static_cast<int>(j));
      value.push_back(v);
    }

    std::size_t size() const { return value.size(); }

    /// Orders the entries by row and column, with each position once.
    void compress();
  };

  /// Entries of the lower triangle of a symmetric matrix.
  struct SymmetricEntries : MatrixEntries
  {
    void add(std::size_t i, std::size_t j, double v)
    {
      MatrixEntries::add(std::max(i, j), std::min(i, j), v);
    }

    /// y += A x.
    void vmult_add(const std::vector<double> &x, std::vector<double> &y) const;
  };

  /// Several sparse vectors with common rows: value[lanes * e + l] is the value of vector l in the
  /// row index[e]. Rows ascend, each once.
  struct SparseHalves
  {
    static constexpr std::size_t lanes = 8;
    std::vector<int> index;
    std::vector<double> value;
  };

  /// How a sparse Cholesky factor is computed and stored.
  enum class CholeskyMethod
  {
    simplicial, ///< LDL^T, entry by entry
    supernodal, ///< LL^T, dense blocks of columns by the BLAS
    automatic   ///< supernodal from SparseCholesky::least_supernodal_flops on
  };

  /**
   * Factor of a sparse symmetric positive definite matrix by CHOLMOD with a fill-reducing order.
   * Order and pattern of the factor are kept while the pattern of the matrix is the same, explicit
   * zeros included.
   */
  class SparseCholesky
  {
  public:
    /// Operations per entry of the factor from which `automatic` is supernodal. With the reference
    /// BLAS, which Debian installs, supernodal factors and solves are slower below this value. With
    /// CHOLMOD's default of 40 solves of small bodies would take twice as long
    /// (doc/results/local_solvers.md).
    static constexpr double least_supernodal_flops = 300.;

    explicit SparseCholesky(CholeskyMethod method = CholeskyMethod::simplicial);
    SparseCholesky(SparseCholesky &&) noexcept;
    SparseCholesky &operator=(SparseCholesky &&) noexcept;
    ~SparseCholesky();

    /// Orders a matrix of @p n rows with these positions, each diagonal entry among them, for its
    /// factor. Returns the number of entries of the factor, zeros in dense blocks aside.
    std::size_t order(std::size_t n, const SymmetricEntries &positions);

    /**
     * Factors a matrix of @p n rows. Returns n, or the row whose pivot is not larger than @p
     * smallest_pivot times its diagonal entry: the matrix is then not definite to working
     * precision, and is not factored.
     */
    std::size_t factor(std::size_t n, const SymmetricEntries &entries, double smallest_pivot);

    /// x = A^-1 x of the matrix factored last.
    void solve(std::vector<double> &x) const;

    /**
     * Halves of solutions for the matrix factored last: y(b) = D^-1/2 L^-1 P b with the order P and
     * the factor L D L^T, so that a^T A^-1 b = y(a) . y(b), for up to SparseHalves::lanes
     * right-hand sides @p b at once. They have entries only on the paths of the elimination tree
     * from the rows of b to the root, and only these are computed (T. A. Davis, Direct Methods for
     * Sparse Linear Systems (2006), 3.2 and 4.1).
     */
    void half_solutions(const std::vector<const LinearForm *> &b, SparseHalves &y) const;

    /// True if the factor of the matrix factored last is supernodal.
    bool is_supernodal() const;

    /// Operations of the factorisation over entries of the factor: a mean length of its columns,
    /// with more weight for long columns. 0: nothing is factored.
    double flops_per_entry() const;

    /// Numbers stored in the factor, the zeros in dense blocks included.
    std::size_t n_entries() const;

    /// Bytes of the factor.
    std::size_t memory_consumption() const;

  private:
    friend std::vector<unsigned int> fill_reducing_order(std::size_t, const SymmetricEntries &);
    struct Workspace; ///< CHOLMOD's
    std::unique_ptr<Workspace> work;
  };

  /// The rows in an order of elimination for which the Cholesky factor of a matrix with these
  /// positions has few entries. Each diagonal entry must be among them.
  std::vector<unsigned int> fill_reducing_order(std::size_t n, const SymmetricEntries &positions);
} // namespace taut

#endif
