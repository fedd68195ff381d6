// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constrained_solver_h
#define taut_constrained_solver_h

#include <taut/substructure/local_solver.h>

#include <boost/container/small_vector.hpp>

#include <vector>

namespace taut
{
  /**
   * Solves for coordinates q and Lagrange multipliers s of a small body with inner constraints,
   *
   *     [ A  G^T ] [ q ]   [ b ]
   *     [ G   0  ] [ s ] = [ c ],
   *
   * with an orthogonal basis of the motions that G allows, and one of the other motions, so that
   * neither part rounds by the size of the other. A has to be positive definite on the allowed
   * motions only. Dependent rows of G are left out.
   */
  class ConstrainedSolver : public LocalSolver
  {
  public:
    /// The first @p n_coordinates DoFs are q, all others are s.
    explicit ConstrainedSolver(const unsigned int n_coordinates) : n(n_coordinates) {}

    void factor(const std::vector<ScaledMatrix> &summands,
                const std::vector<unsigned int> &constrained) override;
    void solve(std::vector<double> &x) const override;
    void column(const LinearForm &rhs, WindowedVector &x) const override;
    double flexibility(const LinearForm &rhs) const override;

  private:
    /// Of the coordinates: a rigid body has twelve, which need no memory of their own.
    using ReducedVector = boost::container::small_vector<double, 12>;

    void find_bases();
    void factor_reduced();

    int n, m = 0, r = 0;       ///< numbers of q and s, and of independent rows of G
    std::vector<char> is_held; ///< DoFs
    std::vector<double> A;     ///< n x n
    std::vector<double> G;     ///< rows, then, in Fortran's order, R of the scaled and sorted ones
    std::vector<double> scale; ///< of the rows
    std::vector<int> rows;     ///< from 1, in the order of R
    std::vector<double> Q;     ///< columns: motions that G prescribes, then allowed motions
    std::vector<double> cholesky;  ///< of A on the motions that G allows
    std::vector<double> tau, work; ///< of LAPACK, in find_bases()
    std::vector<double> AT;        ///< A times these motions, in factor_reduced()
  };
} // namespace taut

#endif
