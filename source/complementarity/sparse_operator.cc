// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/complementarity/sparse_operator.h>

#include <algorithm>
#include <cmath>

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
    border.resize(n_border);
    for (BorderRow &row : border)
    {
      row.entries.assign(n, 0.);
      row.inside.clear();
      row.inside.reserve(n_interior);
    }
    for (Factor *const used : {&factor, &shifted_factor})
    {
      used->response.assign(n_border, std::vector<double>(n_interior, 0.));
      used->is_current.assign(n_border, 0);
      used->schur.reinit(n_border);
    }
    set_interior({});
  }

  void SparseOperator::set_interior(const SymmetricEntries &entries)
  {
    interior = entries;
    for (std::size_t i = 0; i < n_interior; ++i)
      interior.add(i, i, 0.);
    interior.compress();
    diagonal_entry.resize(n_interior);
    for (std::size_t e = 0; e < interior.size(); ++e)
      if (interior.row[e] == interior.column[e])
        diagonal_entry[interior.row[e]] = e;
    factor.is_factored = shifted_factor.is_factored = false;
  }

  void SparseOperator::set_border(const std::size_t i, const std::vector<double> &entries)
  {
    const std::size_t b = i - n_interior;
    BorderRow &row = border[b];
    if (row.entries == entries)
      return;
    std::copy(entries.begin(), entries.end(), row.entries.begin());
    row.inside.clear();
    for (std::size_t j = 0; j < n_interior; ++j)
      if (entries[j] != 0.)
        row.inside.push_back(static_cast<unsigned int>(j));
    for (std::size_t k = n_interior; k < n; ++k)
      border[k - n_interior].entries[i] = entries[k];
    factor.is_current[b] = shifted_factor.is_current[b] = 0;
  }

  void SparseOperator::set_diagonal(const std::size_t i, const double value)
  {
    double &entry =
        i < n_interior ? interior.value[diagonal_entry[i]] : border[i - n_interior].entries[i];
    if (entry == value)
      return;
    entry = value;
    for (Factor *const used : {&factor, &shifted_factor})
      if (i >= n_interior)
        used->is_current[i - n_interior] = 0;
      else if (used->is_factored && used->active[i])
        used->is_factored = false;
  }

  /// y = sum_j weight(F_ij) weight(x_j).
  template <typename Weight>
  void SparseOperator::multiply(const std::vector<double> &x, std::vector<double> &y,
                                const Weight &weight) const
  {
    y.assign(n, 0.);
    for (std::size_t e = 0; e < interior.size(); ++e)
    {
      const int i = interior.row[e], j = interior.column[e];
      const double entry = weight(interior.value[e]);
      y[i] += entry * weight(x[j]);
      if (i != j)
        y[j] += entry * weight(x[i]);
    }
    for (std::size_t b = 0; b < border.size(); ++b)
    {
      const BorderRow &row = border[b];
      const double x_b = weight(x[n_interior + b]);
      double sum = 0.;
      for (const unsigned int j : row.inside)
      {
        const double entry = weight(row.entries[j]);
        sum += entry * weight(x[j]);
        y[j] += entry * x_b;
      }
      for (std::size_t j = n_interior; j < n; ++j)
        sum += weight(row.entries[j]) * weight(x[j]);
      y[n_interior + b] = sum;
    }
  }

  void SparseOperator::apply(const std::vector<double> &x, std::vector<double> &y) const
  {
    multiply(x, y, [](const double number) { return number; });
  }

  void SparseOperator::apply_absolute(const std::vector<double> &x, std::vector<double> &y) const
  {
    multiply(x, y, [](const double number) { return std::abs(number); });
  }

  bool SparseOperator::prepare(Factor &used, const std::vector<std::size_t> &set,
                               const double shift)
  {
    active.assign(n_interior, 0);
    active_border.clear();
    for (const std::size_t i : set)
      if (i < n_interior)
        active[i] = 1;
      else
        active_border.push_back(i - n_interior);
    if (!used.is_factored || used.shift != shift || used.active != active)
    {
      used.shift = shift;
      used.active = active;
      used.is_current.assign(border.size(), 0);
      used.is_factored = factor_interior(used);
    }
    if (!used.is_factored)
      return false;
    for (const std::size_t b : active_border)
    {
      if (!used.is_current[b])
        respond(used, b);
      if (!(used.schur.diagonal(b) > smallest_pivot * diagonal(n_interior + b)))
        return false;
    }
    return true;
  }

  /// Factors F_aa + shift diag(F_aa) in the pattern of all rows; rows that are not active have a
  /// unit diagonal alone. Returns false if rows are dependent.
  bool SparseOperator::factor_interior(Factor &used)
  {
    factored = interior;
    for (std::size_t e = 0; e < factored.size(); ++e)
    {
      const int i = factored.row[e], j = factored.column[e];
      if (i == j)
        factored.value[e] = active[i] ? factored.value[e] * (1. + used.shift) : 1.;
      else if (!active[i] || !active[j])
        factored.value[e] = 0.;
    }
    return used.interior.factor(n_interior, factored, smallest_pivot) == n_interior;
  }

  /// The response of row b of the border, and its row of the Schur complement.
  void SparseOperator::respond(Factor &used, const std::size_t b) const
  {
    const BorderRow &row = border[b];
    std::vector<double> &response = used.response[b];
    response.assign(n_interior, 0.);
    for (const unsigned int j : row.inside)
      if (active[j])
        response[j] = row.entries[j];
    used.interior.solve(response);
    used.is_current[b] = 1;
    for (std::size_t q = 0; q < border.size(); ++q)
      if (used.is_current[q])
        used.schur.set(b, q,
                       row.entries[n_interior + q] * (q == b ? 1. + used.shift : 1.) -
                           inside(b, used.response[q]));
  }

  /// F_ba x_a, where x is 0 on rows of the interior that are not active.
  double SparseOperator::inside(const std::size_t b, const std::vector<double> &x) const
  {
    double sum = 0.;
    for (const unsigned int j : border[b].inside)
      sum += border[b].entries[j] * x[j];
    return sum;
  }

  /**
   * Block elimination with the interior a and the border b:
   *
   *     (F_bb - F_ba F_aa^-1 F_ab) x_b = r_b - F_ba F_aa^-1 r_a,
   *     x_a = F_aa^-1 r_a - F_aa^-1 F_ab x_b.
   */
  bool SparseOperator::solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs,
                             const double shift, std::vector<double> &x)
  {
    Factor &used = shift == 0. ? factor : shifted_factor;
    if (!prepare(used, set, shift))
      return false;
    work.assign(n_interior, 0.);
    for (std::size_t i = 0; i < n_interior; ++i)
      if (active[i])
        work[i] = rhs[i];
    used.interior.solve(work);
    rhs_border.assign(border.size(), 0.);
    for (const std::size_t b : active_border)
      rhs_border[b] = rhs[n_interior + b] - inside(b, work);
    if (!used.schur.solve(active_border, rhs_border, 0., x_border))
      return false;
    x.resize(n);
    std::copy(work.begin(), work.end(), x.begin());
    for (const std::size_t b : active_border)
      for (std::size_t i = 0; i < n_interior; ++i)
        x[i] -= used.response[b][i] * x_border[b];
    std::copy(x_border.begin(), x_border.end(), x.begin() + n_interior);
    return true;
  }

  void SparseOperator::condensed_diagonal(const std::vector<std::size_t> &wanted,
                                          const std::vector<std::size_t> &set, const double shift,
                                          std::vector<double> &result)
  {
    result.assign(n, 0.);
    for (const std::size_t i : wanted)
      result[i] = diagonal(i);
    if (prepare(factor, set, 0.))
      condense(factor, wanted, result);
    else if (prepare(shifted_factor, set, shift))
      condense(shifted_factor, wanted, result);
  }

  /// Takes F_ia F_aa^-1 F_ai of the current set from F_ii of the rows that are wanted.
  void SparseOperator::condense(Factor &used, const std::vector<std::size_t> &wanted,
                                std::vector<double> &result)
  {
    const std::size_t none = wanted.size();
    std::vector<std::size_t> place(n, none);
    for (std::size_t k = 0; k < wanted.size(); ++k)
      place[wanted[k]] = k;
    std::vector<LinearForm> columns(wanted.size());
    const auto add = [&](const std::size_t i, const unsigned int j, const double entry)
    {
      if (place[i] != none && active[j])
        columns[place[i]].add(j, entry);
    };
    for (std::size_t e = 0; e < interior.size(); ++e)
    {
      add(interior.row[e], interior.column[e], interior.value[e]);
      if (interior.row[e] != interior.column[e])
        add(interior.column[e], interior.row[e], interior.value[e]);
    }
    for (std::size_t b = 0; b < border.size(); ++b)
      for (const unsigned int j : border[b].inside)
        add(n_interior + b, j, border[b].entries[j]);

    SparseHalves halves;
    for (std::size_t first = 0; n_interior > 0 && first < wanted.size();
         first += SparseHalves::lanes)
    {
      const std::size_t n_lanes = std::min(SparseHalves::lanes, wanted.size() - first);
      std::vector<const LinearForm *> together;
      for (std::size_t l = 0; l < n_lanes; ++l)
        together.push_back(&columns[first + l]);
      used.interior.half_solutions(together, halves);
      for (std::size_t e = 0; e < halves.index.size(); ++e)
        for (std::size_t l = 0; l < n_lanes; ++l)
          result[wanted[first + l]] -= std::pow(halves.value[SparseHalves::lanes * e + l], 2);
    }

    rhs_border.assign(border.size(), 0.);
    for (std::size_t k = 0; k < wanted.size(); ++k)
    {
      for (const std::size_t b : active_border)
        rhs_border[b] = border[b].entries[wanted[k]] - columns[k].dot(used.response[b]);
      if (!active_border.empty() && used.schur.solve(active_border, rhs_border, 0., x_border))
        for (const std::size_t b : active_border)
          result[wanted[k]] -= rhs_border[b] * x_border[b];
    }
  }
} // namespace taut
