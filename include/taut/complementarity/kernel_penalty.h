// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_kernel_penalty_h
#define taut_kernel_penalty_h

#include <taut/complementarity/dense_operator.h>
#include <taut/complementarity/problem.h>

namespace taut
{
  /**
   * The penalty 1/2 (G N + e)^T R (G N + e) on the unbalanced loads of floating bodies, with R = (G
   * W G^T)^-1 and W_i = 1 / F_ii. With multipliers scaled by sqrt(F_ii), G^T R G is the projector
   * on the kernel: it does not depend on the units or the choice of the kernel vectors.
   */
  class KernelPenalty
  {
  public:
    /// Keeps a reference to @p problem. Where F_ii is nothing, or rounding, the mean of the
    /// diagonal serves for it.
    KernelPenalty(const MixedComplementarityProblem &problem, const DenseOperator &matrix);

    /// G N + e.
    std::vector<double> unbalance(const std::vector<double> &multiplier) const;

    /// The kernel vectors k with |G N + e|_k > tolerance (|e_k| + sum_i |G_ki| |N_i|).
    std::vector<std::size_t> unbalanced(const std::vector<double> &multiplier,
                                        double tolerance) const;

    /// R g. Kernel vectors that depend on each other at the rows share the load.
    std::vector<double> weigh(const std::vector<double> &g);

    /// matrix += factor G^T R G.
    void add_to(DenseOperator &matrix, double factor);

    /// The problem without kernel whose gaps are @p free_gap + G^T amplitude.
    MixedComplementarityProblem without_kernel(const std::vector<double> &free_gap,
                                               const std::vector<double> &amplitude) const;

  private:
    double entry(std::size_t k, std::size_t i) const
    {
      return problem.kernel[k * problem.size() + i];
    }

    const MixedComplementarityProblem &problem;
    std::vector<std::size_t> all; ///< kernel indices
    DenseOperator weights;        ///< G W G^T
  };
} // namespace taut

#endif
