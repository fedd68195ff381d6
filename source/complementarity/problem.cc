// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/complementarity/problem.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace taut
{
  namespace
  {
    double relative(double numerator, double denominator)
    {
      if (numerator == 0.)
        return 0.;
      return denominator == 0. ? std::numeric_limits<double>::infinity() : numerator / denominator;
    }

    /// Like std::max, but not-a-number wins.
    double larger(double a, double b)
    {
      return (b > a || std::isnan(b)) ? b : a;
    }
  } // namespace

  bool MixedComplementarityProblem::in_kernel(std::size_t i) const
  {
    for (std::size_t k = 0; k < n_kernel(); ++k)
      if (kernel[k * size() + i] != 0.)
        return true;
    return false;
  }

  void MixedComplementarityProblem::check(const ComplementarityOperator &matrix) const
  {
    if (matrix.size() != size() || free_gap.size() != size() ||
        (!gap_scale.empty() && gap_scale.size() != size()) || kernel.size() != n_kernel() * size())
      throw std::invalid_argument("the arrays of a complementarity problem differ in size");
  }

  void MixedComplementaritySolution::reset(const MixedComplementarityProblem &problem)
  {
    multiplier.assign(problem.size(), 0.);
    gap.assign(problem.free_gap.begin(), problem.free_gap.end());
    kernel_amplitude.assign(problem.n_kernel(), 0.);
    if (closed.size() != problem.size())
      closed.assign(problem.size(), 0);
  }

  void gap_terms(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
                 const std::vector<double> &multiplier, const std::vector<double> &kernel_amplitude,
                 std::vector<double> &terms)
  {
    const std::size_t n = problem.size();
    matrix.apply_absolute(multiplier, terms);
    for (std::size_t i = 0; i < n; ++i)
      terms[i] += std::abs(problem.free_gap[i]);
    for (std::size_t i = 0; i < problem.gap_scale.size(); ++i)
      terms[i] += problem.gap_scale[i];
    if (kernel_amplitude.empty())
      return;

    const std::vector<double> own_terms = terms;
    for (std::size_t k = 0; k < kernel_amplitude.size(); ++k)
    {
      const double *const column = problem.kernel.data() + k * n;
      double weighted_terms = 0., weights = 0.;
      for (std::size_t i = 0; i < n; ++i)
      {
        weighted_terms += std::abs(column[i]) * own_terms[i];
        weights += column[i] * column[i];
      }
      const double fit = weights > 0. ? weighted_terms / weights : 0.;
      for (std::size_t i = 0; i < n; ++i)
        terms[i] += std::abs(column[i]) * std::max(std::abs(kernel_amplitude[k]), fit);
    }
  }

  void gaps(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
            const std::vector<double> &multiplier, const std::vector<double> &kernel_amplitude,
            std::vector<double> &gap)
  {
    const std::size_t n = problem.size();
    matrix.apply(multiplier, gap);
    for (std::size_t i = 0; i < n; ++i)
      gap[i] += problem.free_gap[i];
    for (std::size_t k = 0; k < kernel_amplitude.size(); ++k)
      for (std::size_t i = 0; i < n; ++i)
        gap[i] += problem.kernel[k * n + i] * kernel_amplitude[k];
  }

  void multiplier_weights(const MixedComplementarityProblem &problem,
                          const ComplementarityOperator &matrix,
                          const std::vector<double> &multiplier, const std::vector<double> &terms,
                          std::vector<double> &weights)
  {
    weights.resize(problem.size());
    for (std::size_t i = 0; i < problem.size(); ++i)
      weights[i] = matrix.diagonal(i);
    if (problem.n_kernel() == 0)
      return;

    double largest = 0.;
    for (const double value : multiplier)
      largest = std::max(largest, std::abs(value));
    if (largest > 0.)
      for (std::size_t i = 0; i < problem.size(); ++i)
        if (problem.in_kernel(i))
          weights[i] = std::max(weights[i], terms[i] / largest);
  }

  void residual(const MixedComplementarityProblem &problem,
                const MixedComplementaritySolution &solution, const std::vector<double> &terms,
                const std::vector<double> &weights, ComplementarityResidual &result)
  {
    const std::size_t n = problem.size();
    result.rows.resize(n);
    result.kernel.resize(problem.n_kernel());
    result.max = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      const double force = weights[i] * solution.multiplier[i];
      const double gap = solution.gap[i];
      const double violation = (problem.unilateral[i] && force < gap) ? force : gap;
      result.rows[i] = relative(std::abs(violation), terms[i]);
      result.max = larger(result.max, result.rows[i]);
    }
    for (std::size_t k = 0; k < problem.n_kernel(); ++k)
    {
      double balance = problem.kernel_load[k];
      double scale = std::abs(balance);
      for (std::size_t i = 0; i < n; ++i)
      {
        const double g = problem.kernel[k * n + i];
        const double known_to = weights[i] > 0. ? terms[i] / weights[i] : 0.;
        balance += g * solution.multiplier[i];
        scale += std::abs(g) * (std::abs(solution.multiplier[i]) + known_to);
      }
      result.kernel[k] = relative(std::abs(balance), scale);
      result.max = larger(result.max, result.kernel[k]);
    }
  }

  ComplementarityResidual residual(const MixedComplementarityProblem &problem,
                                   const ComplementarityOperator &matrix,
                                   const MixedComplementaritySolution &solution)
  {
    std::vector<double> terms, weights;
    gap_terms(problem, matrix, solution.multiplier, solution.kernel_amplitude, terms);
    multiplier_weights(problem, matrix, solution.multiplier, terms, weights);
    ComplementarityResidual result;
    residual(problem, solution, terms, weights, result);
    return result;
  }
} // namespace taut
