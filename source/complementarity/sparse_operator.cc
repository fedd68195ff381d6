// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/complementarity/bordered_cholesky.h>
#include <taut/complementarity/sparse_operator.h>

#include <cmath>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Smallest pivot of an independent row, relative to its diagonal entry.
    constexpr double smallest_pivot = 1e-12;
  } // namespace

  void SparseOperator::reinit(const std::size_t n_rows, const std::size_t n_border)
  {
    n = n_rows;
    n_interior = n_rows - n_border;
    border.assign(n_border, std::vector<double>(n, 0.));
    diagonal_entries.assign(n, 0.);
    set_interior({});
  }

  void SparseOperator::set_interior(const SymmetricEntries &entries)
  {
    interior = entries;
    interior.compress();
    std::fill(diagonal_entries.begin(), diagonal_entries.begin() + n_interior, 0.);
    diagonal_position.assign(n_interior, interior.size());
    for (std::size_t k = 0; k < interior.size(); ++k)
      if (interior.row[k] == interior.column[k])
      {
        diagonal_entries[interior.row[k]] = interior.value[k];
        diagonal_position[interior.row[k]] = k;
      }
    factor.active.clear();
    shifted_factor.active.clear();
  }

  void SparseOperator::set_border(const std::size_t i, const std::vector<double> &entries)
  {
    border[i - n_interior] = entries;
    for (std::size_t k = n_interior; k < n; ++k)
      border[k - n_interior][i] = entries[k];
    diagonal_entries[i] = entries[i];
  }

  void SparseOperator::set_diagonal(const std::size_t i, const double value)
  {
    diagonal_entries[i] = value;
    if (i >= n_interior)
    {
      border[i - n_interior][i] = value;
      return;
    }
    interior.value[diagonal_position[i]] = value;
    factor.active.clear();
    shifted_factor.active.clear();
  }

  /// y = sum_j weight(F_ij) x_j.
  template <typename Weight>
  void SparseOperator::multiply(const std::vector<double> &x, std::vector<double> &y,
                                const Weight &weight) const
  {
    y.assign(n, 0.);
    for (std::size_t k = 0; k < interior.size(); ++k)
    {
      const int i = interior.row[k], j = interior.column[k];
      const double entry = weight(interior.value[k]);
      y[i] += entry * x[j];
      if (i != j)
        y[j] += entry * x[i];
    }
    for (std::size_t b = 0; b < border.size(); ++b)
    {
      const std::vector<double> &row = border[b];
      const double x_b = x[n_interior + b];
      double sum = 0.;
      for (std::size_t j = 0; j < n; ++j)
        sum += weight(row[j]) * x[j];
      y[n_interior + b] = sum;
      for (std::size_t j = 0; j < n_interior; ++j)
        y[j] += weight(row[j]) * x_b;
    }
  }

  void SparseOperator::apply(const std::vector<double> &x, std::vector<double> &y) const
  {
    multiply(x, y, [](const double entry) { return entry; });
  }

  void SparseOperator::apply_absolute(const std::vector<double> &x, std::vector<double> &y) const
  {
    std::vector<double> size(n);
    for (std::size_t i = 0; i < n; ++i)
      size[i] = std::abs(x[i]);
    multiply(size, y, [](const double entry) { return std::abs(entry); });
  }

  /// Open rows keep their place with their diagonal alone, so that the pattern does not change.
  bool SparseOperator::update(Factor &used, const std::vector<char> &active,
                              const double shift) const
  {
    if (used.active == active && used.shift == shift)
      return used.is_definite;
    SymmetricEntries entries = interior;
    for (std::size_t k = 0; k < entries.size(); ++k)
    {
      const int i = entries.row[k], j = entries.column[k];
      double &value = entries.value[k];
      if (i == j)
        value = active[i] ? value * (1. + shift) : 1.;
      else if (!active[i] || !active[j])
        value = 0.;
    }
    used.is_definite = used.interior.factor(n_interior, entries, smallest_pivot) == n_interior;
    used.active = active;
    used.shift = shift;
    return used.is_definite;
  }

  bool SparseOperator::solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs,
                             const double shift, std::vector<double> &x)
  {
    std::vector<char> active(n_interior, 0);
    std::vector<std::size_t> border_rows;
    x.assign(n, 0.);
    for (const std::size_t i : set)
    {
      x[i] = rhs[i];
      if (i < n_interior)
        active[i] = 1;
      else
        border_rows.push_back(i);
    }
    Factor &used = shift == 0. ? factor : shifted_factor;
    if (n_interior > 0 && !update(used, active, shift))
      return false;
    used.shift = shift;
    return solve_border(used, border_rows, x);
  }

  /**
   * Block elimination with the interior a and the border b:
   *
   *     (F_bb - F_ba F_aa^-1 F_ab) x_b = r_b - F_ba F_aa^-1 r_a,   x_a = F_aa^-1 r_a - F_aa^-1 F_ab
   * x_b.
   */
  bool SparseOperator::solve_border(const Factor &used, const std::vector<std::size_t> &rows,
                                    std::vector<double> &x) const
  {
    std::vector<double> x_a(x.begin(), x.begin() + n_interior);
    if (n_interior > 0)
      used.interior.solve(x_a);
    const std::size_t m = rows.size();
    std::vector<std::vector<double>> responses(m);
    std::vector<double> pivots(m * m), r_b(m), x_b(m);
    std::vector<std::size_t> all(m);
    std::iota(all.begin(), all.end(), 0);
    for (std::size_t p = 0; p < m; ++p)
    {
      const std::vector<double> &row = border[rows[p] - n_interior];
      std::vector<double> &response = responses[p];
      response.assign(n_interior, 0.);
      for (std::size_t j = 0; j < n_interior; ++j)
        if (used.active[j])
          response[j] = row[j];
      r_b[p] = x[rows[p]] - std::inner_product(response.begin(), response.end(), x_a.begin(), 0.);
      if (n_interior > 0)
        used.interior.solve(response);
      for (std::size_t q = 0; q <= p; ++q)
      {
        const std::vector<double> &other = border[rows[q] - n_interior];
        double entry = row[rows[q]] * (p == q ? 1. + used.shift : 1.);
        for (std::size_t j = 0; j < n_interior; ++j)
          entry -= other[j] * response[j];
        pivots[p * m + q] = entry;
      }
      if (!(pivots[p * m + p] > smallest_pivot * diagonal_entries[rows[p]]))
        return false;
    }
    BorderedCholesky schur;
    schur.reinit(m);
    if (!schur.factor(pivots, all, 0.))
      return false;
    schur.solve(r_b, x_b);
    for (std::size_t p = 0; p < m; ++p)
    {
      x[rows[p]] = x_b[p];
      for (std::size_t j = 0; j < n_interior; ++j)
        x_a[j] -= responses[p][j] * x_b[p];
    }
    std::copy(x_a.begin(), x_a.end(), x.begin());
    return true;
  }
} // namespace taut
