// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/repeated_rows.h"
#include "base/pivots.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Part of the largest multiplier of a combination below which one is rounding: pivots of
    /// dependent rows are 1e-12, and their square roots enter.
    constexpr double no_part = 1e-5;

    /// Pivots over the diagonal entry of rows that do not depend on others, to half of the digits.
    /// With one between it and dependent_pivot nothing is said to repeat.
    constexpr double distinct = 1e-8;

    /// Part of its terms up to which F z is that of a search which is about to end: the largest
    /// error with which Newton's method of a step may end.
    constexpr double nearly_exact = 1e-5;

    /// Most bilateral rows for a dense factor, which takes a second for them: the many rows between
    /// parts of a body do not repeat each other.
    constexpr std::size_t most_rows = 2000;

    double largest(const std::vector<double> &z)
    {
      double result = 0.;
      for (const double value : z)
        result = std::max(result, std::fabs(value));
      return result;
    }
  } // namespace

  bool RepeatedRows::find(const MixedComplementarityProblem &problem,
                          const ComplementarityOperator &matrix, const double exact)
  {
    const std::vector<std::size_t> before = repeated;
    set_rows(problem, matrix);
    repeated.clear();
    // Cholesky's factor with the largest pivot next, so that the rows that are left are those that
    // depend on the others most.
    const std::size_t n = bilateral.size();
    std::vector<double> left(n, 1.);
    std::vector<std::vector<double>> columns;
    std::vector<char> is_left(n, 1);
    double pivot = 1.;
    while (columns.size() < n)
    {
      std::size_t p = n;
      for (std::size_t q = 0; q < n; ++q)
        if (is_left[q] && (p == n || left[q] > left[p]))
          p = q;
      if (!(left[p] > dependent_pivot))
        break;
      pivot = left[p];
      is_left[p] = 0;
      std::vector<double> column(n, 0.);
      for (std::size_t q = 0; q < n; ++q)
      {
        column[q] = rows(q, p) / std::sqrt(rows(q, q) * rows(p, p));
        for (const std::vector<double> &other : columns)
          column[q] -= other[q] * other[p];
        column[q] /= std::sqrt(pivot);
        left[q] -= column[q] * column[q];
      }
      columns.push_back(std::move(column));
    }
    for (std::size_t p = 0; p < n; ++p)
      if (is_left[p])
        repeated.push_back(bilateral[p]);
    set_combinations();
    const bool is_clear = pivot >= distinct && null_vectors.size() == repeated.size();
    if (!is_clear || !are_exact(problem, matrix, exact))
    {
      repeated.clear();
      null_vectors.clear();
    }
    return repeated != before;
  }

  /// Whether F z = 0 and G z = 0 to rounding: of rows whose F is small beside G^T W G the factor
  /// does not say it.
  bool RepeatedRows::are_exact(const MixedComplementarityProblem &problem,
                               const ComplementarityOperator &matrix, const double exact) const
  {
    std::vector<double> z(problem.size(), 0.), product;
    for (const std::vector<double> &own : null_vectors)
    {
      double size = 0.;
      for (std::size_t p = 0; p < bilateral.size(); ++p)
      {
        z[bilateral[p]] = own[p];
        size += std::sqrt(matrix.diagonal(bilateral[p])) * std::fabs(own[p]);
      }
      matrix.apply(z, product);
      for (std::size_t i = 0; i < product.size(); ++i)
        if (std::fabs(product[i]) > exact * std::sqrt(matrix.diagonal(i)) * size)
          return false;
      for (const LinearForm &G : problem.null_space)
      {
        double sum = 0., terms = 0.;
        for (std::size_t e = 0; e < G.index.size(); ++e)
        {
          sum += G.value[e] * z[G.index[e]];
          terms += std::fabs(G.value[e] * z[G.index[e]]);
        }
        if (std::fabs(sum) > exact * terms)
          return false;
      }
    }
    return true;
  }

  const MixedComplementarityProblem &
  RepeatedRows::without(const MixedComplementarityProblem &problem)
  {
    reduced = problem;
    for (const std::size_t i : repeated)
      reduced.cones[i] = Cone::zero();
    return reduced;
  }

  /// Sets the bilateral rows that anything moves, and F + G^T W G on them, which has the null space
  /// of F and G; W makes both parts of one size.
  void RepeatedRows::set_rows(const MixedComplementarityProblem &problem,
                              const ComplementarityOperator &matrix)
  {
    const std::size_t n = problem.size();
    const std::vector<char> in_null_space = problem.rows_in_null_space();
    bilateral.clear();
    std::vector<std::size_t> position(n, n);
    double largest_entry = 0.;
    for (std::size_t i = 0; i < n; ++i)
      if (problem.cones[i].is_free() &&
          (matrix.diagonal(i) > 0. || (!in_null_space.empty() && in_null_space[i])))
      {
        position[i] = bilateral.size();
        bilateral.push_back(i);
        largest_entry = std::max(largest_entry, matrix.diagonal(i));
      }
    if (bilateral.size() > most_rows || matrix.is_iterative())
      bilateral.clear();
    rows.reinit(bilateral.size());
    std::vector<double> unit(n, 0.), column;
    for (std::size_t p = 0; p < bilateral.size(); ++p)
    {
      unit[bilateral[p]] = 1.;
      matrix.apply(unit, column);
      unit[bilateral[p]] = 0.;
      for (std::size_t q = p; q < bilateral.size(); ++q)
        rows.set(q, p, column[bilateral[q]]);
    }
    for (std::size_t k = 0; k < problem.n_null_space(); ++k)
    {
      const LinearForm &G = problem.null_space[k];
      double squares = 0.;
      for (const double value : G.value)
        squares = std::max(squares, value * value);
      const double weight = problem.resistance(k) > 0. ? 1. / problem.resistance(k)
                            : squares > 0. ? (largest_entry > 0. ? largest_entry : 1.) / squares
                                           : 0.;
      for (std::size_t e = 0; e < G.index.size(); ++e)
        for (std::size_t f = 0; f < G.index.size(); ++f)
          if (const std::size_t p = position[G.index[e]], q = position[G.index[f]];
              p < bilateral.size() && q <= p)
            rows.set(p, q, rows(p, q) + weight * G.value[e] * G.value[f]);
    }
  }

  /// Each repeated row with the independent rows that it is minus the sum of.
  void RepeatedRows::set_combinations()
  {
    null_vectors.clear();
    std::vector<double> column(bilateral.size(), 0.), z;
    std::vector<std::size_t> independent, others;
    for (std::size_t p = 0; p < bilateral.size(); ++p)
      (std::binary_search(repeated.begin(), repeated.end(), bilateral[p]) ? others : independent)
          .push_back(p);
    for (const std::size_t p : others)
    {
      for (const std::size_t q : independent)
        column[q] = -rows(q, p);
      if (!rows.solve(independent, column, 0., z))
        continue;
      z[p] = 1.;
      null_vectors.push_back(z);
    }
  }

  void RepeatedRows::spread(const MixedComplementarityProblem &problem,
                            const ComplementarityOperator &matrix, std::vector<double> &multiplier)
  {
    set_rows(problem, matrix);
    set_combinations();
    // Far from the end of a search the combinations still move something.
    if (!are_exact(problem, matrix, nearly_exact))
      return;
    const std::size_t n = null_vectors.size();
    DenseOperator products(n);
    std::vector<double> along(n, 0.), amplitude;
    std::vector<std::size_t> all(n);
    std::iota(all.begin(), all.end(), 0);
    for (std::size_t k = 0; k < n; ++k)
    {
      for (std::size_t l = 0; l <= k; ++l)
        products.set(k, l,
                     std::inner_product(null_vectors[k].begin(), null_vectors[k].end(),
                                        null_vectors[l].begin(), 0.));
      for (std::size_t p = 0; p < bilateral.size(); ++p)
        along[k] -= null_vectors[k][p] * multiplier[bilateral[p]];
    }
    if (!products.solve(all, along, 0., amplitude))
      return;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t p = 0; p < bilateral.size(); ++p)
        multiplier[bilateral[p]] += amplitude[k] * null_vectors[k][p];
  }

  std::vector<std::size_t> RepeatedRows::partners(const std::size_t row) const
  {
    const auto found = std::lower_bound(bilateral.begin(), bilateral.end(), row);
    if (found == bilateral.end() || *found != row)
      return {};
    std::vector<char> is_wanted;
    for (const std::vector<double> &z : null_vectors)
      is_wanted.push_back(std::fabs(z[found - bilateral.begin()]) > no_part * largest(z));
    return rows_of(is_wanted);
  }

  std::vector<std::size_t> RepeatedRows::all_partners() const
  {
    return rows_of(std::vector<char>(null_vectors.size(), 1));
  }

  /// Rows of the wanted combinations.
  std::vector<std::size_t> RepeatedRows::rows_of(const std::vector<char> &is_wanted) const
  {
    std::vector<std::size_t> result;
    for (std::size_t p = 0; p < bilateral.size(); ++p)
      for (std::size_t k = 0; k < null_vectors.size(); ++k)
        if (is_wanted[k] && std::fabs(null_vectors[k][p]) > no_part * largest(null_vectors[k]))
        {
          result.push_back(bilateral[p]);
          break;
        }
    return result;
  }
} // namespace taut
