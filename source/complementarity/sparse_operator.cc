// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/sparse_operator.h"
#include "base/pivots.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
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
    interior.set_pattern(n_interior, {});
    set_pattern({});
  }

  void SparseOperator::set_pattern(const SymmetricEntries &entries)
  {
    SymmetricEntries all = entries;
    for (std::size_t i = 0; i < n_interior; ++i)
      for (std::size_t e = interior.begin[i]; e < interior.begin[i + 1]; ++e)
        all.add(i, interior.column[e], 0.);
    interior.set_pattern(n_interior, std::move(all));
    if (interior.column.size() > 2 * entries.size())
      interior.set_pattern(n_interior, entries);
    pattern = nullptr;
    factor.is_set_up = shifted_factor.is_set_up = false;
  }

  void SparseOperator::set_interior(const SymmetricEntries &entries)
  {
    if (interior.column.size() > 2 * entries.size() || !interior.set_values(entries))
    {
      set_pattern(entries);
      interior.set_values(entries);
    }
    for (Factor *const used : {&factor, &shifted_factor})
      if (used->is_set_up)
        used->interior.changed();
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
    for (Factor *const used : {&factor, &shifted_factor})
      if (used->is_set_up)
        used->is_current[b] = 0;
  }

  void SparseOperator::set_diagonal(const std::size_t i, const double value)
  {
    double &entry = i < n_interior ? interior.diagonal[i] : border[i - n_interior].entries[i];
    if (entry == value)
      return;
    entry = value;
    for (Factor *const used : {&factor, &shifted_factor})
    {
      if (!used->is_set_up)
        continue;
      if (i < n_interior)
        used->interior.changed(i);
      else
        used->is_current[i - n_interior] = 0;
    }
  }

  /// y = sum_j weight(F_ij) weight(x_j).
  template <typename Weight>
  void SparseOperator::multiply(const std::vector<double> &x, std::vector<double> &y,
                                const Weight &weight) const
  {
    y.assign(n, 0.);
    for (std::size_t i = 0; i < n_interior; ++i)
    {
      const double x_i = weight(x[i]);
      double sum = 0.;
      for (std::size_t e = interior.begin[i]; e < interior.begin[i + 1]; ++e)
      {
        const unsigned int j = interior.column[e];
        const double entry = weight(interior.value[e]);
        sum += entry * weight(x[j]);
        y[j] += entry * x_i;
      }
      y[i] = sum + weight(interior.diagonal[i]) * x_i;
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

  void SparseOperator::Factor::reinit(const std::shared_ptr<const EliminationPattern> &pattern,
                                      const std::size_t n_border)
  {
    interior.reinit(pattern);
    response.assign(n_border, std::vector<double>(pattern->size(), 0.));
    reached.assign(n_border, {});
    for (std::vector<unsigned int> &places : reached)
      places.reserve(pattern->size());
    schur.reinit(n_border);
    forget_responses();
    is_set_up = true;
  }

  void SparseOperator::Factor::forget_responses()
  {
    is_current.assign(response.size(), 0);
  }

  double SparseOperator::Factor::share(const std::size_t b, const std::vector<double> &x) const
  {
    const std::vector<double> &own = response[b], &inverse = interior.inverse_pivots();
    double sum = 0.;
    for (const unsigned int k : reached[b])
      sum += own[k] * inverse[k] * x[k];
    return sum;
  }

  bool SparseOperator::prepare(Factor &used, const std::vector<std::size_t> &set,
                               const double shift)
  {
    if (!pattern)
      pattern = std::make_shared<EliminationPattern>(interior);
    if (!used.is_set_up)
      used.reinit(pattern, border.size());
    active.assign(n_interior, 0);
    active_border.clear();
    for (const std::size_t i : set)
      if (i < n_interior)
        active[i] = 1;
      else
        active_border.push_back(i - n_interior);
    if (used.shift != shift)
      used.forget_responses();
    used.shift = shift;
    if (!used.interior.factor(interior, active, shift))
      return false;
    if (used.version != used.interior.version())
      used.forget_responses();
    used.version = used.interior.version();
    for (const std::size_t b : active_border)
    {
      if (!used.is_current[b])
        respond(used, b);
      if (!(used.schur.diagonal(b) > dependent_pivot * diagonal(n_interior + b)))
        return false;
    }
    return true;
  }

  /// The response of row b of the border, and its row of the Schur complement.
  void SparseOperator::respond(Factor &used, const std::size_t b) const
  {
    const BorderRow &row = border[b];
    std::vector<double> &response = used.response[b];
    std::vector<unsigned int> &places = used.reached[b];
    for (const unsigned int k : places)
      response[k] = 0.;
    places.clear();
    for (const unsigned int j : row.inside)
      if (active[j])
      {
        places.push_back(pattern->position[j]);
        response[places.back()] = row.entries[j];
      }
    used.interior.solve_lower(response, places);
    used.is_current[b] = 1;
    for (std::size_t q = 0; q < border.size(); ++q)
      if (used.is_current[q])
        used.schur.set(b, q,
                       row.entries[n_interior + q] * (q == b ? 1. + used.shift : 1.) -
                           used.share(b, used.response[q]));
  }

  /**
   * Block elimination with the interior a and the border b, z = L^-1 r_a:
   *
   *     (F_bb - F_ba F_aa^-1 F_ab) x_b = r_b - F_ba L^-T D^-1 z,
   *     x_a = L^-T D^-1 (z - L^-1 F_ab x_b).
   */
  bool SparseOperator::solve(const std::vector<std::size_t> &set, const std::vector<double> &rhs,
                             const double shift, std::vector<double> &x)
  {
    Factor &used = of_shift(shift);
    if (!prepare(used, set, shift))
      return false;
    work.assign(n_interior, 0.);
    for (std::size_t i = 0; i < n_interior; ++i)
      if (active[i])
        work[pattern->position[i]] = rhs[i];
    used.interior.solve_lower(work);
    rhs_border.assign(border.size(), 0.);
    for (const std::size_t b : active_border)
      rhs_border[b] = rhs[n_interior + b] - used.share(b, work);
    if (!used.schur.solve(active_border, rhs_border, 0., x_border))
      return false;
    for (const std::size_t b : active_border)
      for (const unsigned int k : used.reached[b])
        work[k] -= used.response[b][k] * x_border[b];
    const std::vector<double> &inverse = used.interior.inverse_pivots();
    for (std::size_t k = 0; k < n_interior; ++k)
      work[k] *= inverse[k];
    used.interior.solve_upper(work);
    x.resize(n);
    for (std::size_t i = 0; i < n_interior; ++i)
      x[i] = work[pattern->position[i]];
    std::copy(x_border.begin(), x_border.end(), x.begin() + n_interior);
    return true;
  }

  void SparseOperator::condensed_diagonal(const std::vector<std::size_t> &wanted,
                                          const std::vector<std::size_t> &set, const double shift,
                                          const SharedRows *, std::vector<double> &result)
  {
    result.assign(n, 0.);
    const bool is_definite = prepare(factor, set, 0.);
    Factor &used = is_definite ? factor : shifted_factor;
    const bool is_solved = is_definite || prepare(used, set, shift);
    work.assign(n_interior, 0.);
    rhs_border.assign(border.size(), 0.);
    for (const std::size_t i : wanted)
      result[i] = is_solved ? condensed(used, i) : diagonal(i);
  }

  /// F_ii - F_ia F_aa^-1 F_ai of the current set; `work` is 0 before and after.
  double SparseOperator::condensed(Factor &used, const std::size_t i)
  {
    places.clear();
    const auto place = [&](const std::size_t j, const double entry)
    {
      if (!active[j])
        return;
      places.push_back(pattern->position[j]);
      work[places.back()] = entry;
    };
    if (i < n_interior)
    {
      place(i, interior.diagonal[i]);
      for (std::size_t e = interior.neighbours_begin[i]; e < interior.neighbours_begin[i + 1]; ++e)
        place(interior.neighbours[e].row, interior.value[interior.neighbours[e].entry]);
    }
    else
      for (const unsigned int j : border[i - n_interior].inside)
        place(j, border[i - n_interior].entries[j]);
    used.interior.solve_lower(work, places);
    double result = diagonal(i);
    for (const std::size_t b : active_border)
      rhs_border[b] = border[b].entries[i] - used.share(b, work);
    for (const unsigned int k : places)
    {
      result -= work[k] * used.interior.inverse_pivots()[k] * work[k];
      work[k] = 0.;
    }
    if (!active_border.empty() && used.schur.solve(active_border, rhs_border, 0., x_border))
      for (const std::size_t b : active_border)
        result -= rhs_border[b] * x_border[b];
    return result;
  }
} // namespace taut
