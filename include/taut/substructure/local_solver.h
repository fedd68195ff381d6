// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_local_solver_h
#define taut_local_solver_h

#include <taut/base/linear_form.h>
#include <taut/substructure/symmetric_matrix.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /// factor * matrix, a summand of A.
  using ScaledMatrix = std::pair<double, const SymmetricMatrix *>;

  /**
   * Factorisation of the symmetric positive definite matrix A of one substructure. Derive from it
   * for a body whose matrix has a structure of its own (Substructure::make_solver()). Constrained
   * DoFs have an identity row: their entry of a right-hand side is ignored, and their entry of a
   * solution is zero.
   */
  class LocalSolver
  {
  public:
    virtual ~LocalSolver() = default;

    /**
     * Factors A = sum of the summands, which share one size and pattern, with the DoFs @p
     * constrained, sorted, held at zero. Throws BodyNotHeld, naming the DoF, at a pivot that is not
     * positive to working precision.
     */
    virtual void factor(const std::vector<ScaledMatrix> &summands,
                        const std::vector<unsigned int> &constrained) = 0;

    /// x = A^-1 x.
    virtual void solve(std::vector<double> &x) const = 0;

    /**
     * x = A^-1 rhs. Tails below 1e-18 of the largest entry of the same kind are left out, unless @p
     * rhs acts on the DoFs of more than one element.
     */
    virtual void column(const LinearForm &rhs, WindowedVector &x) const = 0;

    /// rhs^T A^-1 rhs, the flexibility of the body under one row [m/N, rad/(N m)].
    virtual double flexibility(const LinearForm &rhs) const = 0;

    /// The flexibility of each of @p rows alone; rows near each other may cost less together.
    virtual void own_flexibilities(const std::vector<const LinearForm *> &rows,
                                   std::vector<double> &F) const;

    /// F_ij = b_i^T A^-1 b_j of all pairs of @p rows, the lower triangle row after row: i + 1
    /// numbers of row i.
    virtual void flexibilities(const std::vector<const LinearForm *> &rows,
                               std::vector<double> &F) const;
  };

  /**
   * Block-tridiagonal LDL^T, eliminated from both ends at once, for matrices with a block size of 1
   * to 4, or 6. The complete factors of both directions are kept, so that a column of A^-1 follows
   * from a local recurrence.
   */
  std::unique_ptr<LocalSolver> make_block_tridiagonal_solver(unsigned int block_size);

  /// CHOLMOD, for any pattern: entry by entry, or in dense blocks where these are faster.
  std::unique_ptr<LocalSolver> make_sparse_direct_solver();

  /**
   * The solver @p name, "block tridiagonal" or "sparse direct", for a matrix; a matrix without
   * blocks always gets the sparse solver. Throws UserError for another name.
   */
  std::unique_ptr<LocalSolver> make_local_solver(const std::string &name,
                                                 const SymmetricMatrix &matrix);
} // namespace taut

#endif
