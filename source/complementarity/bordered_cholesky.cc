// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/bordered_cholesky.h"
#include "base/instruction_set.h"
#include "base/pivots.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Eight partial sums: one alone would wait for the latency of each addition.
    double dot(const double *a, const double *b, std::size_t n)
    {
      double sums[8] = {};
      std::size_t i = 0;
      for (; i + 8 <= n; i += 8)
#pragma omp simd
        for (std::size_t k = 0; k < 8; ++k)
          sums[k] += a[i + k] * b[i + k];
      double rest = 0.;
      for (; i < n; ++i)
        rest += a[i] * b[i];
      return rest + (((sums[0] + sums[1]) + (sums[2] + sums[3])) +
                     ((sums[4] + sums[5]) + (sums[6] + sums[7])));
    }
  } // namespace

  void BorderedCholesky::reinit(std::size_t n_rows)
  {
    n = n_rows;
    n_valid = 0;
    rows.clear();
    rows.reserve(n);
    positions.assign(n, n);
    first.assign(n, 0);
    lower.assign(n * n, 0.);
    inverse_pivots.assign(n, 0.);
    work.assign(n, 0.);
  }

  void BorderedCholesky::changed(std::size_t i, std::size_t j)
  {
    n_valid = std::min(n_valid, std::max(positions[i], positions[j]));
  }

  bool BorderedCholesky::factor(const std::vector<double> &matrix,
                                const std::vector<std::size_t> &set, double shift)
  {
    if (shift != factored_shift)
      n_valid = 0;
    factored_shift = shift;

    const std::size_t n_common = std::min(n_valid, set.size());
    const std::size_t n_kept =
        std::mismatch(set.begin(), set.begin() + n_common, rows.begin()).first - set.begin();
    for (std::size_t p = n_kept; p < rows.size(); ++p)
      positions[rows[p]] = n;
    rows.resize(n_kept);
    for (std::size_t p = n_kept; p < set.size(); ++p)
    {
      rows.push_back(set[p]);
      positions[set[p]] = p;
    }

    bool is_definite = true;
    vectorised(
        [&]
        {
          for (n_valid = n_kept; is_definite && n_valid < rows.size(); n_valid += is_definite)
            is_definite = factor_row(matrix, n_valid, shift);
        });
    return is_definite;
  }

  bool BorderedCholesky::factor_row(const std::vector<double> &matrix, std::size_t position,
                                    double shift)
  {
    const std::size_t row = rows[position];
    double *const entries = &lower[position * n];
    std::size_t begin = position;
    for (std::size_t q = 0; q < position; ++q)
    {
      entries[q] = matrix[std::max(row, rows[q]) * n + std::min(row, rows[q])];
      if (entries[q] != 0. && q < begin)
        begin = q;
    }
    first[position] = begin;

    for (std::size_t q = begin; q < position; ++q)
    {
      const std::size_t start = std::max(begin, first[q]);
      const double *const other = &lower[q * n];
      if (start < q)
        entries[q] -= dot(entries + start, other + start, q - start);
      entries[q] *= inverse_pivots[q];
    }
    const double diagonal = matrix[row * n + row] * (1. + shift);
    const double pivot = diagonal - dot(entries + begin, entries + begin, position - begin);
    if (!(pivot > dependent_pivot * diagonal))
      return false;
    inverse_pivots[position] = 1. / std::sqrt(pivot);
    return true;
  }

  void BorderedCholesky::solve(const std::vector<double> &rhs, std::vector<double> &x)
  {
    vectorised(
        [&]
        {
          const std::size_t m = rows.size();
          for (std::size_t p = 0; p < m; ++p)
          {
            const std::size_t begin = first[p];
            work[p] = (rhs[rows[p]] - dot(&lower[p * n + begin], &work[begin], p - begin)) *
                      inverse_pivots[p];
          }
          x.assign(n, 0.);
          for (std::size_t p = m; p-- > 0;)
          {
            const double value = work[p] * inverse_pivots[p];
            const double *const entries = &lower[p * n];
            double *const rest = work.data();
#pragma omp simd
            for (std::size_t q = first[p]; q < p; ++q)
              rest[q] -= entries[q] * value;
            x[rows[p]] = value;
          }
        });
  }
} // namespace taut
