// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/problem.h"
#include "base/least_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace taut
{
  namespace
  {
    /// Entries of F below this, relative to the largest one, are rounding.
    constexpr double negligible = 1e-16;

    /// Part of the loads below which multipliers carry none of them.
    constexpr double balanced = 1e-3;

    /// Largest multiplier that carries the terms of a load on a null space vector alone; 0 if
    /// unknown.
    double size_of_loads(const MixedComplementarityProblem &problem)
    {
      double result = 0.;
      std::vector<double> largest(problem.null_space_terms.size(), 0.);
      for (std::size_t k = 0; k < largest.size(); ++k)
        for (const double value : problem.null_space[k].value)
          largest[k] = std::max(largest[k], std::abs(value));
      if (problem.shared)
        problem.shared->max(largest);
      for (std::size_t k = 0; k < largest.size(); ++k)
        if (largest[k] > 0.)
          result = std::max(result, problem.null_space_terms[k] / largest[k]);
      return result;
    }

    /// A null space vector on the rows that count on this rank in sums over all ranks.
    LinearForm of_own_rows(const MixedComplementarityProblem &problem, const std::size_t k)
    {
      LinearForm result;
      for (std::size_t e = 0; e < problem.null_space[k].index.size(); ++e)
        if (const unsigned int i = problem.null_space[k].index[e];
            !problem.shared || problem.shared->is_own(i))
          result.add(i, problem.null_space[k].value[e]);
      return result;
    }

    /// Calls @p add with each null space vector, on the rows that count on this rank, and adds up
    /// @p sums over the ranks.
    template <typename Add>
    void sum_over_null_space(const MixedComplementarityProblem &problem, std::vector<double> &sums,
                             const Add &add)
    {
      for (std::size_t k = 0; k < problem.n_null_space(); ++k)
        if (problem.shared)
          add(k, of_own_rows(problem, k));
        else
          add(k, problem.null_space[k]);
      if (problem.shared)
        problem.shared->sum(sums);
    }

    /// 0 where the numerator may be what numbers without all of their digits leave: a residual is a
    /// sum of terms, which have them from the smallest normal number on.
    double relative(double numerator, double denominator)
    {
      if (numerator <= least_number)
        return 0.;
      return denominator == 0. ? std::numeric_limits<double>::infinity() : numerator / denominator;
    }

    /// Like std::max, but not-a-number wins.
    double larger(double a, double b)
    {
      return (b > a || std::isnan(b)) ? b : a;
    }
  } // namespace

  void MixedComplementarityProblem::forces_on_null_space(const std::vector<double> &multiplier,
                                                         std::vector<double> &result) const
  {
    result.resize(n_null_space());
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] = of_own_rows(*this, k).dot(multiplier);
    if (shared)
      shared->sum(result);
  }

  void MixedComplementarityProblem::sizes_on_null_space(const std::vector<double> &multiplier,
                                                        std::vector<double> &result) const
  {
    result.assign(n_null_space(), 0.);
    for (std::size_t k = 0; k < result.size(); ++k)
    {
      const LinearForm own = of_own_rows(*this, k);
      for (std::size_t e = 0; e < own.index.size(); ++e)
        result[k] += std::fabs(own.value[e] * multiplier[own.index[e]]);
    }
    if (shared)
      shared->sum(result);
  }

  std::vector<char> MixedComplementarityProblem::rows_in_null_space() const
  {
    std::vector<char> result(n_null_space() > 0 ? size() : 0, 0);
    for (const LinearForm &vector : null_space)
      for (std::size_t e = 0; e < vector.index.size(); ++e)
        if (vector.value[e] != 0.)
          result[vector.index[e]] = 1;
    return result;
  }

  bool MixedComplementarityProblem::has_resistance() const
  {
    return std::any_of(null_space_resistance.begin(), null_space_resistance.end(),
                       [](const double value) { return value > 0.; });
  }

  void MixedComplementarityProblem::check(const ComplementarityOperator &matrix) const
  {
    if (matrix.size() != size() || free_gap.size() != size() ||
        (!gap_scale.empty() && gap_scale.size() != size()) || null_space.size() != n_null_space() ||
        (!null_space_resistance.empty() && null_space_resistance.size() != n_null_space()) ||
        std::any_of(null_space.begin(), null_space.end(),
                    [&](const LinearForm &vector)
                    {
                      return std::any_of(vector.index.begin(), vector.index.end(),
                                         [&](const unsigned int i) { return i >= size(); });
                    }))
      throw std::invalid_argument("the arrays of a complementarity problem differ in size");
  }

  void MixedComplementaritySolution::reset(const MixedComplementarityProblem &problem)
  {
    multiplier.assign(problem.size(), 0.);
    gap.assign(problem.free_gap.begin(), problem.free_gap.end());
    mode_amplitude.assign(problem.n_null_space(), 0.);
    if (closed.size() != problem.size())
      closed.assign(problem.size(), 0);
  }

  void gap_terms(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
                 const std::vector<double> &multiplier, const std::vector<double> &mode_amplitude,
                 std::vector<double> &terms)
  {
    const std::size_t n = problem.size();
    matrix.apply_absolute(multiplier, terms);
    for (std::size_t i = 0; i < n; ++i)
      terms[i] += std::abs(problem.free_gap[i]);
    for (std::size_t i = 0; i < problem.gap_scale.size(); ++i)
      terms[i] += problem.gap_scale[i];
    if (mode_amplitude.empty())
      return;

    const std::size_t n_modes = mode_amplitude.size();
    std::vector<double> largest(n_modes, 0.), sums(2 * n_modes, 0.);
    for (std::size_t k = 0; k < n_modes; ++k)
      for (const unsigned int i : problem.null_space[k].index)
        if (multiplier[i] != 0.)
          largest[k] = std::max(largest[k], matrix.diagonal(i));
    if (problem.shared)
      problem.shared->max(largest);
    const std::vector<double> own_terms = terms;
    const auto add_sums = [&](const std::size_t k, const LinearForm &vector)
    {
      for (std::size_t e = 0; e < vector.index.size(); ++e)
      {
        const std::size_t i = vector.index[e];
        if (multiplier[i] == 0.)
          continue;
        const double g = std::abs(vector.value[e]);
        const double weight =
            largest[k] > 0. ? largest[k] / std::max(matrix.diagonal(i), negligible * largest[k])
                            : 1.;
        sums[2 * k] += weight * g * own_terms[i];
        sums[2 * k + 1] += weight * g * g;
      }
    };
    sum_over_null_space(problem, sums, add_sums);
    for (std::size_t k = 0; k < n_modes; ++k)
    {
      const LinearForm &vector = problem.null_space[k];
      const double fit = sums[2 * k + 1] > 0. ? sums[2 * k] / sums[2 * k + 1] : 0.;
      const double size = std::max(std::abs(mode_amplitude[k]), fit);
      for (std::size_t e = 0; e < vector.index.size(); ++e)
        terms[vector.index[e]] += std::abs(vector.value[e]) * size;
    }
  }

  void gaps(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
            const std::vector<double> &multiplier, const std::vector<double> &mode_amplitude,
            std::vector<double> &gap)
  {
    const std::size_t n = problem.size();
    matrix.apply(multiplier, gap);
    for (std::size_t i = 0; i < n; ++i)
      gap[i] += problem.free_gap[i];
    for (std::size_t k = 0; k < mode_amplitude.size(); ++k)
      problem.null_space[k].add_to(mode_amplitude[k], gap);
  }

  void multiplier_weights(const MixedComplementarityProblem &problem,
                          const ComplementarityOperator &matrix,
                          const std::vector<double> &multiplier, const std::vector<double> &terms,
                          std::vector<double> &weights)
  {
    weights.resize(problem.size());
    for (std::size_t i = 0; i < problem.size(); ++i)
      weights[i] = matrix.diagonal(i);
    if (problem.n_null_space() == 0)
      return;

    double largest = 0.;
    for (const double value : multiplier)
      largest = std::max(largest, std::abs(value));
    largest = problem.max(largest);
    const double loads = size_of_loads(problem);
    if (largest < balanced * loads)
      largest = loads;
    if (largest > 0.)
    {
      const std::vector<char> in_null_space = problem.rows_in_null_space();
      for (std::size_t i = 0; i < problem.size(); ++i)
        if (in_null_space[i])
          weights[i] = std::max(weights[i], terms[i] / largest);
    }
  }

  void residual(const MixedComplementarityProblem &problem,
                const MixedComplementaritySolution &solution, const std::vector<double> &terms,
                const std::vector<double> &weights, ComplementarityResidual &result)
  {
    const std::size_t n = problem.size();
    result.rows.resize(n);
    result.null_space.resize(problem.n_null_space());
    result.max = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      const double violation =
          problem.cones[i].violation(weights[i], solution.multiplier[i], solution.gap[i]);
      result.rows[i] = relative(std::abs(violation), terms[i]);
      result.max = larger(result.max, result.rows[i]);
    }
    result.max = problem.max(result.max);
    std::vector<double> &sums = result.sums;
    sums.assign(2 * problem.n_null_space(), 0.);
    const auto add_sums = [&](const std::size_t k, const LinearForm &vector)
    {
      for (std::size_t e = 0; e < vector.index.size(); ++e)
      {
        const std::size_t i = vector.index[e];
        const double g = vector.value[e];
        const double known_to = weights[i] > 0. ? terms[i] / weights[i] : 0.;
        sums[2 * k] += g * solution.multiplier[i];
        sums[2 * k + 1] += std::abs(g) * (std::abs(solution.multiplier[i]) + known_to);
      }
    };
    sum_over_null_space(problem, sums, add_sums);
    for (std::size_t k = 0; k < problem.n_null_space(); ++k)
    {
      double balance = problem.null_space_load[k];
      double scale = std::abs(balance);
      if (problem.resistance(k) > 0.)
      {
        const double resisted = problem.resistance(k) * solution.mode_amplitude[k];
        balance -= resisted;
        scale += std::abs(resisted);
      }
      if (!problem.null_space_terms.empty())
        scale += problem.null_space_terms[k];
      balance += sums[2 * k];
      scale += sums[2 * k + 1];
      result.null_space[k] = relative(std::abs(balance), scale);
      result.max = larger(result.max, result.null_space[k]);
    }
  }

  ComplementarityResidual residual(const MixedComplementarityProblem &problem,
                                   const ComplementarityOperator &matrix,
                                   const MixedComplementaritySolution &solution)
  {
    std::vector<double> terms, weights;
    gap_terms(problem, matrix, solution.multiplier, solution.mode_amplitude, terms);
    multiplier_weights(problem, matrix, solution.multiplier, terms, weights);
    ComplementarityResidual result;
    residual(problem, solution, terms, weights, result);
    return result;
  }

  ComplementarityResidual close_rows(const MixedComplementarityProblem &problem,
                                     const ComplementarityOperator &matrix,
                                     MixedComplementaritySolution &solution)
  {
    ComplementarityResidual result;
    std::vector<double> terms, weights;
    gaps(problem, matrix, solution.multiplier, solution.mode_amplitude, solution.gap);
    gap_terms(problem, matrix, solution.multiplier, solution.mode_amplitude, terms);
    multiplier_weights(problem, matrix, solution.multiplier, terms, weights);
    residual(problem, solution, terms, weights, result);
    for (std::size_t i = 0; i < problem.size(); ++i)
      solution.closed[i] =
          problem.cones[i].is_free() ? weights[i] > 0. : solution.multiplier[i] > 0.;
    return result;
  }
} // namespace taut
