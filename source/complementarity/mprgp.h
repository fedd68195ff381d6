// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mprgp_h
#define taut_mprgp_h

#include "complementarity/null_space_penalty.h"
#include "complementarity/options.h"

#include <memory>
#include <vector>

namespace taut
{
  /**
   * Modified proportioning with reduced gradient projections, MPRGP (Z. Dostal, Optimal Quadratic
   * Programming Algorithms, Springer 2009, chapter 5), with the augmented Lagrangian SMALBE
   * (chapter 6) for floating bodies. Use it where F has no entries: it takes products with F alone,
   * and no step raises the energy.
   *
   * Rows are scaled to F_ii = 1. Conjugate gradients run on the free rows and the closed ones, as
   * long as the free gradient outweighs the chopped one; a step that would make a multiplier
   * negative ends at zero, with a projected gradient step of length a / |F|; rows open by a step
   * along the chopped gradient. With the least eigenvalue l of a definite F, the energy above its
   * minimum falls at least by the factor 1 - (2 - a) l / (4 a |F|) in a step, for 1 <= a < 2. Of
   * dependent rows there is no rate.
   */
  class Mprgp
  {
  public:
    /// False, with @p solution as it is, if no minimum of the energy is found: rows may contradict
    /// each other, or nothing may hold a body.
    bool solve(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
               MixedComplementaritySolution &solution);

    /// Products with F, and steps that closed or opened rows, in the last call.
    unsigned int n_products() const { return products; }
    unsigned int n_changes() const { return changes; }

    const ComplementarityResidual &residual() const { return final_residual; }

  private:
    void multiply(const std::vector<double> &y, std::vector<double> &Hy);
    void find_norm();
    void split(const std::vector<double> &y);
    bool descend(const std::vector<double> &d, double wanted, std::vector<double> &y);

    const MixedComplementarityProblem *problem = nullptr;
    const ComplementarityOperator *matrix = nullptr;
    MixedComplementarityProblem held; ///< with the null space vectors without resistance
    std::unique_ptr<NullSpacePenalty> penalty;
    std::vector<double> scale;     ///< F_ii^-1/2
    double norm = 0., factor = 0.; ///< of F in scaled rows, and of the penalty
    std::vector<double> multiplier, g, free_gradient, reduced, chopped;
    unsigned int products = 0, changes = 0;
    ComplementarityResidual final_residual;
  };
} // namespace taut

#endif
