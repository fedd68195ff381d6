// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/null_space_penalty.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut
{
  namespace
  {
    /// A diagonal entry of F of a pseudo-inverse below this, relative to the mean, is rounding. It
    /// bounds the weights by 1e6 over the mean.
    constexpr double smallest_diagonal = 1e-6;

    /// W_i.
    std::vector<double> inverse_diagonal(const ComplementarityOperator &matrix,
                                         const std::vector<char> &rows)
    {
      const std::size_t n = matrix.size();
      double mean = 0.;
      for (std::size_t i = 0; i < n; ++i)
        mean += matrix.diagonal(i) / n;
      std::vector<double> weights(n, 0.);
      for (std::size_t i = 0; i < n; ++i)
        if (rows[i] && matrix.diagonal(i) > smallest_diagonal * mean)
          weights[i] = 1. / matrix.diagonal(i);
        else if (rows[i])
          weights[i] = mean > 0. ? 1. / mean : 1.;
      return weights;
    }
  } // namespace

  NullSpacePenalty::NullSpacePenalty(const MixedComplementarityProblem &problem,
                                     const ComplementarityOperator &matrix,
                                     const std::vector<char> &rows)
      : problem(problem), null_space(problem.n_null_space() * problem.size(), 0.),
        all(problem.n_null_space()), row_weights(inverse_diagonal(matrix, rows)),
        weights(problem.n_null_space())
  {
    std::iota(all.begin(), all.end(), 0);
    for (const std::size_t k : all)
      for (std::size_t e = 0; e < problem.null_space[k].index.size(); ++e)
        null_space[k * problem.size() + problem.null_space[k].index[e]] +=
            problem.null_space[k].value[e];
    std::vector<double> solution;
    for (const std::size_t k : all)
    {
      for (std::size_t l = 0; l <= k; ++l)
      {
        double sum = 0.;
        for (std::size_t i = 0; i < problem.size(); ++i)
          sum += entry(k, i) * row_weights[i] * entry(l, i);
        weights.set(k, l, sum);
      }
      independent.push_back(k);
      if (!weights.solve(independent, problem.null_space_load, 0., solution))
        independent.pop_back();
    }
  }

  std::vector<double> NullSpacePenalty::unbalance(const std::vector<double> &multiplier) const
  {
    std::vector<double> sums = problem.null_space_load;
    for (const std::size_t k : all)
      for (std::size_t i = 0; i < problem.size(); ++i)
        sums[k] += entry(k, i) * multiplier[i];
    return sums;
  }

  std::vector<double> NullSpacePenalty::balance_terms(const std::vector<double> &multiplier) const
  {
    double largest = 0.;
    for (const double value : multiplier)
      largest = std::max(largest, std::abs(value));
    std::vector<double> terms(all.size());
    for (const std::size_t k : all)
    {
      terms[k] = std::abs(problem.null_space_load[k]);
      for (std::size_t i = 0; i < problem.size(); ++i)
        terms[k] += std::abs(entry(k, i)) * largest;
    }
    return terms;
  }

  std::vector<std::size_t> NullSpacePenalty::unbalanced(const std::vector<double> &multiplier,
                                                        double tolerance) const
  {
    const std::vector<double> sums = unbalance(multiplier), terms = balance_terms(multiplier);
    std::vector<std::size_t> indices;
    for (const std::size_t k : all)
      if (!(std::abs(sums[k]) <= tolerance * terms[k]))
        indices.push_back(k);
    return indices;
  }

  std::vector<double> NullSpacePenalty::weigh(const std::vector<double> &g)
  {
    std::vector<double> result;
    weights.solve(independent, g, 0., result);
    return result;
  }

  std::vector<double> NullSpacePenalty::closing_amplitude(const std::vector<double> &gap)
  {
    std::vector<double> sums(all.size(), 0.);
    for (const std::size_t k : all)
      for (std::size_t i = 0; i < problem.size(); ++i)
        sums[k] -= entry(k, i) * row_weights[i] * gap[i];
    return weigh(sums);
  }

  std::vector<double> NullSpacePenalty::amplitude_terms(const std::vector<double> &multiplier)
  {
    const std::vector<double> terms = balance_terms(multiplier);
    std::vector<double> sums(all.size(), 0.);
    for (const std::size_t l : all)
    {
      std::vector<double> unit(all.size(), 0.);
      unit[l] = terms[l];
      const std::vector<double> column = weigh(unit);
      for (const std::size_t k : all)
        sums[k] += std::abs(column[k]);
    }
    return sums;
  }

  void NullSpacePenalty::add_to(DenseOperator &matrix, double factor)
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
  NullSpacePenalty::without_null_space(const std::vector<double> &free_gap,
                                       const std::vector<double> &gap_scale,
                                       const std::vector<double> &amplitude) const
  {
    MixedComplementarityProblem result;
    result.cones = problem.cones;
    result.free_gap = free_gap;
    result.gap_scale = gap_scale;
    for (std::size_t i = 0; i < problem.size(); ++i)
      for (const std::size_t k : all)
      {
        const double motion = entry(k, i) * amplitude[k];
        result.free_gap[i] += motion;
        result.gap_scale[i] += std::abs(motion);
      }
    return result;
  }
} // namespace taut
