// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_null_space_penalty_h
#define taut_null_space_penalty_h

#include "complementarity/dense_operator.h"
#include "complementarity/problem.h"

namespace taut
{
  /**
   * The penalty 1/2 (G N + e)^T R (G N + e) on the unbalanced loads of floating bodies, with R = (G
   * W G^T)^-1 and W_i = 1 / F_ii. With multipliers scaled by sqrt(F_ii), G^T R G is the projector
   * on the null space: it does not depend on the units or the choice of the null space vectors.
   */
  class NullSpacePenalty
  {
  public:
    /**
     * Keeps a reference to @p problem. If F_ii is zero, or rounding, the mean of the diagonal takes
     * its place, or 1 if this mean is zero, too. Rows that are 0 in @p rows are left out: W_i = 0.
     */
    NullSpacePenalty(const MixedComplementarityProblem &problem,
                     const ComplementarityOperator &matrix, const std::vector<char> &rows);

    /// G N + e.
    std::vector<double> unbalance(const std::vector<double> &multiplier) const;

    /// |e_k| + sum_i |G_ki| max_j |N_j|: a bound of the terms of G N + e that does not vanish with
    /// them.
    std::vector<double> balance_terms(const std::vector<double> &multiplier) const;

    /// The null space vectors k with |G N + e|_k larger than @p tolerance times its terms.
    std::vector<std::size_t> unbalanced(const std::vector<double> &multiplier,
                                        double tolerance) const;

    /// R g. Zero for null space vectors whose motion of the rows depends on that of earlier
    /// vectors.
    std::vector<double> weigh(const std::vector<double> &g);

    /// The amplitude x with the least sum of W_i (D + G^T x)_i^2: the motion that best closes the
    /// gaps of the rows.
    std::vector<double> closing_amplitude(const std::vector<double> &gap);

    /// sum_l |R_kl| times the terms of (G N + e)_l: the scale of the rounding error of R (G N + e).
    std::vector<double> amplitude_terms(const std::vector<double> &multiplier);

    /// matrix += factor G^T R G.
    void add_to(DenseOperator &matrix, double factor);

    /// The problem without null space whose free gaps are @p free_gap + G^T amplitude, with the
    /// terms @p gap_scale.
    MixedComplementarityProblem without_null_space(const std::vector<double> &free_gap,
                                                   const std::vector<double> &gap_scale,
                                                   const std::vector<double> &amplitude) const;

  private:
    double entry(std::size_t k, std::size_t i) const { return null_space[k * problem.size() + i]; }

    const MixedComplementarityProblem &problem;
    std::vector<double> null_space;       ///< G, dense, row-major
    std::vector<std::size_t> all;         ///< null space indices
    std::vector<std::size_t> independent; ///< null space indices whose rows of G W are independent
    std::vector<double> row_weights;      ///< W_i
    DenseOperator weights;                ///< G W G^T
  };
} // namespace taut

#endif
