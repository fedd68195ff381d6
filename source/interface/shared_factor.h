// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_shared_factor_h
#define taut_shared_factor_h

#include <taut/base/communicator.h>
#include <taut/base/sparse_cholesky.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace taut
{
  /**
   * The factor of a sparse symmetric positive definite matrix that all ranks apply together. If it
   * has few entries, as that of a chain with however many rows, the matrix is gathered, and each
   * rank has the factor: a solve then sends nothing. Of a larger one each rank has a share of the
   * rows and of the factor, by MUMPS through Amesos, if they are all processes of MPI_COMM_WORLD:
   * some builds of Amesos know no other communicator, and some have no MUMPS.
   */
  class SharedFactor
  {
  public:
    /// Matrices are shared if their factors, or the shares of the ranks in them, have more than
    /// @p largest_whole entries.
    SharedFactor(const Communicator &processes, std::size_t largest_whole);
    SharedFactor(SharedFactor &&) noexcept;
    SharedFactor &operator=(SharedFactor &&) noexcept;
    ~SharedFactor();

    /// Factors the sum of what the ranks have of the entries. Each diagonal entry must be among
    /// them. @p n_own: rows of this rank, a stretch after those of the ranks before. Returns false
    /// if a pivot is not larger than @p smallest_pivot times its diagonal entry: the matrix is then
    /// not definite to working precision, and is not factored.
    bool factor(std::size_t n_own, SymmetricEntries entries, double smallest_pivot);

    /// x = A^-1 x of the matrix factored last, on all rows.
    void solve(std::vector<double> &x) const;

    /// The same on the rows of this rank, of what each rank has there.
    void solve_own(std::vector<double> &x) const;

    /// Of @p n rows those that a rank has if they are dealt evenly.
    std::size_t even_share(std::size_t n) const
    {
      return n * (processes.rank() + 1) / processes.size() -
             n * processes.rank() / processes.size();
    }

    /// The first row of this rank.
    std::size_t first_row() const { return first; }

  private:
    class Shares;
    bool may_share() const;

    Communicator processes;
    std::size_t largest_whole, n = 0, first = 0;
    std::size_t most_gathered;       ///< entries of a matrix; factors of larger ones are shared
    mutable std::vector<double> all; ///< rows
    SparseCholesky whole{CholeskyMethod::automatic};
    std::unique_ptr<Shares> shares; ///< none: the factor is whole
  };
} // namespace taut

#endif
