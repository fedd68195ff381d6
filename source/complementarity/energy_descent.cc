// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/energy_descent.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace taut
{
  namespace
  {
    /// Entries of a null direction below this, relative to the largest, are zeros. They are
    /// compared by the root of their energies F_ii z_i^2: 1e-14 of the largest energy, a hundred
    /// roundings.
    constexpr double smallest_null_entry = 1e-7;

    /// A multiplier below this, relative to the largest terms, may be rounding: a hundred
    /// roundings. It becomes zero only if no row gets worse.
    constexpr double smallest_multiplier = 1e-14;
  } // namespace

  bool EnergyDescent::start(const MixedComplementarityProblem &new_problem,
                            DenseOperator &new_matrix)
  {
    problem = &new_problem;
    matrix = &new_matrix;
    const std::size_t n = problem->size();
    multipliers.assign(n, 0.);
    is_closed.assign(n, 0);
    blocked.assign(n, 0);
    closed_rows.clear();
    changes = 0;
    update_gaps();

    std::vector<std::size_t> dependent_rows;
    for (std::size_t i = 0; i < n; ++i)
      if (problem->cones[i].is_free() && matrix->diagonal(i) > 0.)
      {
        closed_rows.push_back(i);
        is_closed[i] = 1;
        if (!matrix->solve(closed_rows, rhs, 0., direction))
        {
          open(closed_rows.size() - 1);
          dependent_rows.push_back(i);
        }
      }
    minimize();
    for (const std::size_t i : dependent_rows)
      if (!is_rounding(i, find_null_direction(i)))
        return false;
    return true;
  }

  bool EnergyDescent::descend(const MixedComplementarityProblem &new_problem,
                              DenseOperator &new_matrix)
  {
    problem = &new_problem;
    matrix = &new_matrix;
    blocked.assign(problem->size(), 0);
    update_gaps();
    minimize();
    for (std::size_t closings = 0; closings < 20 * (problem->size() + 5); ++closings)
    {
      const std::size_t row = most_violated();
      if (row == problem->size())
        break;
      if (!close(row))
        return false;
    }
    round_off();
    return true;
  }

  std::size_t EnergyDescent::most_violated() const
  {
    std::size_t row = problem->size();
    double largest_release = 0.;
    for (std::size_t i = 0; i < problem->size(); ++i)
      if (problem->cones[i].may_open() && !is_closed[i] && !blocked[i] &&
          matrix->diagonal(i) > 0. && gap[i] < -options.dead_band * terms[i])
      {
        const double release = gap[i] * gap[i] / matrix->diagonal(i);
        if (release > largest_release)
        {
          largest_release = release;
          row = i;
        }
      }
    return row;
  }

  /// Closes a row; returns false if the row contradicts the closed rows. A row that rounding opens
  /// at once has to wait.
  bool EnergyDescent::close(std::size_t row)
  {
    closed_rows.push_back(row);
    is_closed[row] = 1;
    if (!matrix->solve(closed_rows, rhs, 0., direction))
    {
      open(closed_rows.size() - 1);
      return exchange(row);
    }
    ++changes;
    if (!minimize() && !is_closed[row])
      blocked[row] = 1;
    return true;
  }

  /// Closes a row that depends on the closed rows: one of them has to open.
  bool EnergyDescent::exchange(std::size_t row)
  {
    if (is_rounding(row, find_null_direction(row)))
    {
      blocked[row] = 1;
      return true;
    }
    const std::size_t leaving = first_zero(std::numeric_limits<double>::infinity());
    if (leaving == closed_rows.size())
      return false;

    const std::size_t left = closed_rows[leaving];
    const double length = multipliers[left] / -direction[left];
    bool has_moved = move(length);
    multipliers[row] = length;
    open(leaving);
    closed_rows.push_back(row);
    is_closed[row] = 1;
    ++changes;
    update_gaps();
    has_moved |= minimize();
    if (!has_moved && !is_closed[row])
      blocked[row] = 1;
    return true;
  }

  /// Moves to the minimum on the closed rows, or on the rows that remain closed; returns true if
  /// multipliers have changed.
  bool EnergyDescent::minimize()
  {
    bool has_moved = false;
    for (unsigned int refinement = 0; refinement < options.max_corrections && !closed_rows.empty();)
    {
      // The shift is for nearly dependent rows. The direction is one of descent with the shift,
      // too.
      if (!matrix->solve(closed_rows, rhs, 0., direction))
        matrix->solve(closed_rows, rhs, options.redundancy_shift, direction);
      const std::size_t leaving = first_zero(1.);
      const bool stops = leaving < closed_rows.size();
      const std::size_t left = stops ? closed_rows[leaving] : 0;
      has_moved |= move(stops ? multipliers[left] / -direction[left] : 1.);
      if (stops)
        open(leaving);
      update_gaps();
      if (!stops && is_settled())
        break;
      refinement += !stops;
    }
    return has_moved;
  }

  /// Position of the unilateral row whose multiplier reaches zero first on a path shorter than @p
  /// length; or the end.
  std::size_t EnergyDescent::first_zero(double length) const
  {
    std::size_t position = closed_rows.size();
    for (std::size_t p = 0; p < closed_rows.size(); ++p)
    {
      const std::size_t i = closed_rows[p];
      if (problem->cones[i].may_open() && direction[i] < 0. &&
          multipliers[i] < length * -direction[i])
      {
        length = multipliers[i] / -direction[i];
        position = p;
      }
    }
    return position;
  }

  /// Moves along the direction. If the move exceeds rounding, returns true and unblocks all rows.
  bool EnergyDescent::move(double length)
  {
    bool is_motion = false;
    for (const std::size_t i : closed_rows)
    {
      const double change = length * direction[i];
      multipliers[i] += change;
      is_motion |= matrix->diagonal(i) * std::abs(change) > options.linear_tolerance * terms[i];
    }
    if (is_motion)
      std::fill(blocked.begin(), blocked.end(), 0);
    return is_motion;
  }

  /**
   * Sets multipliers that are rounding of the largest terms to zero. Such a multiplier may be the
   * only term of a neighbouring row, whose gap is then no better than this rounding. The change is
   * kept unless a row gets worse.
   */
  void EnergyDescent::round_off()
  {
    double largest = 0.;
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (matrix->diagonal(i) > 0.)
        largest = std::max(largest, terms[i] / std::sqrt(matrix->diagonal(i)));
    const std::vector<double> exact = multipliers;
    const double exact_residual = largest_residual();
    for (const std::size_t i : closed_rows)
      if (std::sqrt(matrix->diagonal(i)) * std::abs(multipliers[i]) <=
          smallest_multiplier * largest)
        multipliers[i] = 0.;
    update_gaps();
    if (!(largest_residual() <= std::max(exact_residual, options.linear_tolerance)))
    {
      multipliers = exact;
      update_gaps();
    }
  }

  double EnergyDescent::largest_residual() const
  {
    MixedComplementaritySolution solution;
    solution.multiplier = multipliers;
    solution.gap = gap;
    return residual(*problem, *matrix, solution).max;
  }

  void EnergyDescent::open(std::size_t position)
  {
    const std::size_t row = closed_rows[position];
    multipliers[row] = 0.;
    is_closed[row] = 0;
    closed_rows.erase(closed_rows.begin() + position);
    ++changes;
  }

  void EnergyDescent::update_gaps()
  {
    gaps(*problem, *matrix, multipliers, {}, gap);
    gap_terms(*problem, *matrix, multipliers, {}, terms);
    rhs.resize(gap.size());
    std::transform(gap.begin(), gap.end(), rhs.begin(), std::negate<double>());
  }

  bool EnergyDescent::is_settled() const
  {
    return std::all_of(closed_rows.begin(), closed_rows.end(),
                       [this](std::size_t i)
                       { return std::abs(gap[i]) <= options.linear_tolerance * terms[i]; });
  }

  /**
   * Finds the direction z with F z = 0, z_row = 1 (left out of @p direction) and entries on the
   * closed rows, of which this row is a combination. Notes the rows of z and returns sum_i |z_i|
   * s_i, the terms of the gap of the row in this combination.
   */
  double EnergyDescent::find_null_direction(std::size_t row)
  {
    std::vector<double> column(problem->size(), 0.);
    for (const std::size_t i : closed_rows)
      column[i] = -(*matrix)(i, row);
    matrix->solve(closed_rows, column, 0., direction);

    double largest = std::sqrt(matrix->diagonal(row));
    for (const std::size_t i : closed_rows)
      largest = std::max(largest, std::sqrt(matrix->diagonal(i)) * std::abs(direction[i]));

    double null_terms = terms[row];
    contradiction.assign(1, row);
    for (const std::size_t i : closed_rows)
      if (std::sqrt(matrix->diagonal(i)) * std::abs(direction[i]) < smallest_null_entry * largest)
        direction[i] = 0.;
      else
      {
        null_terms += std::abs(direction[i]) * terms[i];
        contradiction.push_back(i);
      }
    std::sort(contradiction.begin(), contradiction.end());
    return null_terms;
  }

  bool EnergyDescent::is_rounding(std::size_t row, double null_terms) const
  {
    return std::abs(gap[row]) <=
           std::max(options.tolerance * terms[row], options.linear_tolerance * null_terms);
  }
} // namespace taut
