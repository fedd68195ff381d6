// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constrained_solver_h
#define taut_constrained_solver_h

#include <taut/substructure/local_solver.h>

#include <vector>

namespace taut
{
  /**
   * Solves for coordinates q and multipliers s of a small body that has constraints inside,
   *
   *     [ A  G^T ] [ q ]   [ b ]
   *     [ G   0  ] [ s ] = [ c ],
   *
   * through an orthogonal basis of the motions that G allows and one of the others, so that neither
   * rounds by the size of the other. A has to be positive definite on the former only. Rows of G
   * that depend on others are left out.
   */
  class ConstrainedSolver : public LocalSolver
  {
  public:
    /// The first @p n_coordinates DoFs are q, the others s.
    explicit ConstrainedSolver(const unsigned int n_coordinates) : n(n_coordinates) {}

    void factor(const std::vector<ScaledMatrix> &summands,
                const std::vector<unsigned int> &constrained) override;
    void solve(std::vector<double> &x) const override;
    void column(const LinearForm &rhs, WindowedVector &x) const override;
    double flexibility(const LinearForm &rhs) const override;

  private:
    void find_bases();
    void factor_reduced();

    unsigned int n, m = 0;                     ///< numbers of q and s
    std::vector<char> is_held;                 ///< DoFs
    std::vector<double> A, G;                  ///< n x n and m x n, row after row
    std::vector<double> Q;                     ///< columns: what G holds, then what it allows
    std::vector<unsigned int> rows;            ///< of G, independent of each other
    std::vector<std::vector<double>> triangle; ///< these rows of G Q
    std::vector<double> cholesky;              ///< of A on the motions that G allows
  };
} // namespace taut

#endif
