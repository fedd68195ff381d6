// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_natural_coarse_problem_h
#define taut_natural_coarse_problem_h

#include <taut/base/linear_form.h>
#include <taut/base/sparse_cholesky.h>

#include <vector>

namespace taut
{
  /**
   * The coarse problem of FETI in statics: the multipliers have to balance the loads on the free
   * motions of the bodies, G x = e. With the orthogonal projector on their null space,
   *
   *     P = 1 - G^T (G G^T)^-1 G,
   *
   * an iteration on P F P keeps the balance that it starts from, and what it leaves of the gaps is
   * G^T alpha (Farhat and Roux 1991).
   */
  class NaturalCoarseProblem
  {
  public:
    /// @p null space has a row of G in each vector, and @p scale a factor for each of its columns;
    /// only the columns of active rows count.
    NaturalCoarseProblem(const std::vector<LinearForm> &null_space,
                         const std::vector<double> &scale, const std::vector<char> &active);

    /// False if the rows of G are dependent: the active rows do not hold a body.
    bool holds_the_bodies() const { return is_definite; }

    /// x += G^T (G G^T)^-1 e.
    void balance(const std::vector<double> &e, std::vector<double> &x) const;

    /// G x.
    std::vector<double> unbalance(const std::vector<double> &x) const;

    /// x = P x.
    void project(std::vector<double> &x) const;

    /// (G G^T)^-1 G x: the amplitudes that fit x best.
    std::vector<double> amplitudes(const std::vector<double> &x) const;

  private:
    std::vector<LinearForm> G;
    SparseCholesky squares; ///< G G^T
    bool is_definite = false;
  };
} // namespace taut

#endif
