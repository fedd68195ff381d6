// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/complementarity/kernel_penalty.h>

#include <cmath>
#include <numeric>

namespace taut
{
  namespace
  {
    /// A diagonal entry of a pseudo-inverse's F below this, relative to the mean, is rounding.
    constexpr double smallest_diagonal = 1e-6;

    /// Relative shift that makes dependent kernel vectors solvable.
    constexpr double dependence_shift = 1e-9;

    /// W_i.
    std::vector<double> row_weights(const DenseOperator &matrix)
    {
      const std::size_t n = matrix.size();
      double mean = 0.;
      for (std::size_t i = 0; i < n; ++i)
        mean += matrix.diagonal(i) / n;
      std::vector<double> weights(n);
      for (std::size_t i = 0; i < n; ++i)
        if (matrix.diagonal(i) > smallest_diagonal * mean)
          weights[i] = 1. / matrix.diagonal(i);
        else
          weights[i] = mean > 0. ? 1. / mean : 1.;
      return weights;
    }
  } // namespace

  KernelPenalty::KernelPenalty(const MixedComplementarityProblem &problem,
                               const DenseOperator &matrix)
      : problem(problem), all(problem.n_kernel()), weights(problem.n_kernel())
  {
    std::iota(all.begin(), all.end(), 0);
    const std::vector<double> W = row_weights(matrix);
    for (const std::size_t k : all)
    {
      for (std::size_t l = 0; l <= k; ++l)
      {
        double sum = 0.;
        for (std::size_t i = 0; i < problem.size(); ++i)
          sum += entry(k, i) * W[i] * entry(l, i);
        weights.set(k, l, sum);
      }
      if (weights.diagonal(k) == 0.) // moves no row
        weights.set(k, k, 1.);
    }
  }

  std::vector<double> KernelPenalty::unbalance(const std::vector<double> &multiplier) const
  {
    std::vector<double> sums = problem.kernel_load;
    for (const std::size_t k : all)
      for (std::size_t i = 0; i < problem.size(); ++i)
        sums[k] += entry(k, i) * multiplier[i];
    return sums;
  }

  std::vector<std::size_t> KernelPenalty::unbalanced(const std::vector<double> &multiplier,
                                                     double tolerance) const
  {
    const std::vector<double> sums = unbalance(multiplier);
    std::vector<std::size_t> indices;
    for (const std::size_t k : all)
    {
      double terms = std::abs(problem.kernel_load[k]);
      for (std::size_t i = 0; i < problem.size(); ++i)
        terms += std::abs(entry(k, i) * multiplier[i]);
      if (!(std::abs(sums[k]) <= tolerance * terms))
        indices.push_back(k);
    }
    return indices;
  }

  std::vector<double> KernelPenalty::weigh(const std::vector<double> &g)
  {
    std::vector<double> result;
    if (!weights.solve(all, g, 0., result))
      weights.solve(all, g, dependence_shift, result);
    return result;
  }

  void KernelPenalty::add_to(DenseOperator &matrix, double factor)
  {
    std::vector<double> column(all.size());
    for (std::size_t j = 0; j < problem.size(); ++j)
    {
      for (const std::size_t k : all)
        column[k] = entry(k, j);
      const std::vector<double> weighed = weigh(column);
      for (std::size_t i = j; i < problem.size(); ++i)
      {
        double sum = 0.;
        for (const std::size_t k : all)
          sum += entry(k, i) * weighed[k];
        matrix.set(i, j, matrix(i, j) + factor * sum);
      }
    }
  }

  MixedComplementarityProblem
  KernelPenalty::without_kernel(const std::vector<double> &free_gap,
                                const std::vector<double> &amplitude) const
  {
    MixedComplementarityProblem result;
    result.unilateral = problem.unilateral;
    result.free_gap = free_gap;
    result.gap_scale = problem.gap_scale;
    result.gap_scale.resize(problem.size(), 0.);
    for (std::size_t i = 0; i < problem.size(); ++i)
    {
      result.gap_scale[i] += std::abs(free_gap[i]);
      for (const std::size_t k : all)
      {
        const double motion = entry(k, i) * amplitude[k];
        result.free_gap[i] += motion;
        result.gap_scale[i] += std::abs(motion);
      }
    }
    return result;
  }
} // namespace taut
