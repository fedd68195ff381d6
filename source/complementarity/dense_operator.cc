// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/dense_operator.h"
#include "base/instruction_set.h"

#include <cmath>

namespace taut
{
  void DenseOperator::reinit(std::size_t n_rows)
  {
    n = n_rows;
    entries.assign(n * n, 0.);
    first.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      first[i] = i;
    factor.reinit(n);
    has_shifted_factor = false;
  }

  void DenseOperator::set(std::size_t i, std::size_t j, double value)
  {
    const std::size_t row = std::max(i, j), column = std::min(i, j);
    double &entry = entries[row * n + column];
    if (entry == value)
      return;
    entry = value;
    factor.changed(i, j);
    if (has_shifted_factor)
      shifted_factor.changed(i, j);

    if (value != 0.)
      first[row] = std::min(first[row], column);
    else
      while (first[row] < row && entries[row * n + first[row]] == 0.)
        ++first[row];
  }

  // Both products walk through the lower triangle once: each entry serves its row and its column.
  void DenseOperator::apply(const std::vector<double> &x, std::vector<double> &y) const
  {
    y.assign(n, 0.);
    vectorised(
        [this, in = x.data(), out = y.data()]
        {
          for (std::size_t i = 0; i < n; ++i)
          {
            const double *const row = &entries[i * n];
            const double x_i = in[i];
            double sum = row[i] * x_i;
#pragma omp simd reduction(+ : sum)
            for (std::size_t j = first[i]; j < i; ++j)
            {
              sum += row[j] * in[j];
              out[j] += row[j] * x_i;
            }
            out[i] += sum;
          }
        });
  }

  void DenseOperator::apply_absolute(const std::vector<double> &x, std::vector<double> &y) const
  {
    y.assign(n, 0.);
    vectorised(
        [this, in = x.data(), out = y.data()]
        {
          for (std::size_t i = 0; i < n; ++i)
          {
            const double *const row = &entries[i * n];
            const double x_i = std::abs(in[i]);
            double sum = std::abs(row[i]) * x_i;
#pragma omp simd reduction(+ : sum)
            for (std::size_t j = first[i]; j < i; ++j)
            {
              const double entry = std::abs(row[j]);
              sum += entry * std::abs(in[j]);
              out[j] += entry * x_i;
            }
            out[i] += sum;
          }
        });
  }

  bool DenseOperator::solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs,
                            double shift, std::vector<double> &x)
  {
    if (shift != 0. && !has_shifted_factor)
    {
      shifted_factor.reinit(n);
      has_shifted_factor = true;
    }
    BorderedCholesky &used = shift == 0. ? factor : shifted_factor;
    if (!used.factor(entries, set, shift))
      return false;
    used.solve(rhs, x);
    return true;
  }

  void DenseOperator::condensed_diagonal(const std::vector<std::size_t> &wanted,
                                         const std::vector<std::size_t> &set, const double shift,
                                         const SharedRows *, std::vector<double> &result)
  {
    column.resize(n);
    result.assign(n, 0.);
    for (const std::size_t i : wanted)
    {
      result[i] = diagonal(i);
      if (set.empty())
        continue;
      for (std::size_t j = 0; j < n; ++j)
        column[j] = (*this)(i, j);
      if (!solve(set, column, 0., solution) && !solve(set, column, shift, solution))
        continue;
      for (const std::size_t b : set)
        result[i] -= column[b] * solution[b];
    }
  }
} // namespace taut
