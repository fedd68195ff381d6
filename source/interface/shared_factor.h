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
   * The factor of a sparse symmetric positive definite matrix that all ranks apply together, to
   * vectors that each of them has whole. A small matrix is gathered, and each rank has its factor:
   * a solve then sends nothing. Of a larger one each rank has a share of the rows and of the
   * factor, by MUMPS through Amesos. That takes all processes of MPI_COMM_WORLD, as Amesos of
   * Debian knows no other communicator; on fewer the matrix is gathered.
   */
  class SharedFactor
  {
  public:
    /// Matrices of more than @p largest_whole rows are shared.
    SharedFactor(const Communicator &processes, std::size_t largest_whole);
    SharedFactor(SharedFactor &&) noexcept;
    SharedFactor &operator=(SharedFactor &&) noexcept;
    ~SharedFactor();

    /// Factors the sum of what the ranks have of the entries. Each diagonal entry must be among
    /// them. Returns false if a pivot is not larger than @p smallest_pivot times its diagonal
    /// entry: the matrix is then not definite to working precision, and is not factored.
    bool factor(std::size_t n, SymmetricEntries entries, double smallest_pivot);

    /// As factor(), of entries that every rank has.
    bool factor_of_all(std::size_t n, const SymmetricEntries &entries, double smallest_pivot);

    /// x = A^-1 x of the matrix factored last.
    void solve(std::vector<double> &x) const;

  private:
    class Shares;
    bool is_shared(std::size_t n) const;

    Communicator processes;
    std::size_t largest_whole;
    SparseCholesky whole{CholeskyMethod::automatic};
    std::unique_ptr<Shares> shares; ///< none: the factor is whole
  };
} // namespace taut

#endif
