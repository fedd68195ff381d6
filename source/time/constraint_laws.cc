// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/constraint_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Relative residual of a law, in terms of its gap, that ends the iteration: a hundred
    /// roundings, and the default Contact tolerance. Rounding may keep it between both; the
    /// residuals of the step then shows it.
    constexpr double converged = 1e-14, stagnated = 1e-8;

    /// Part of their terms to which gaps are solved.
    constexpr double known_to = 1e-12;

    /// A law of n pieces takes at most n linearisations on a single row, and tables have some tens
    /// of pieces. A row that needs more goes to and fro, which the residuals of the step show.
    constexpr int most_linearisations = 200;

    /// Part of the last residual above which the next one is rounding: Newton's method near its end
    /// squares residuals, and far from it they are above `stagnated`.
    constexpr double not_closer = .9;

    /// Lower bound of the slope of a law in its linearisation, over its largest stiffness k. The
    /// rounding of a force N then moves a gap by at most 1e-16 / 1e-9 of N / k.
    constexpr double least_slope = 1e-9;

    /// Bound for a conserving law, whose slope between far open and closed is small, but right.
    constexpr double least_slope_of_conserving = 1e-40;

    /// Relative difference of compressions below which it gives no slope of the mean. Only the
    /// speed of the iteration depends on it: the quotient of this difference is off by 1e-16 /
    /// 1e-5, and the slope in its place by a part of about 1e-5.
    constexpr double least_difference = 1e-5;

    /// The compression @p u, or where the force is zero if it pulls at @p u. This place is searched
    /// only if needed: most links stay closed.
    template <typename Row>
    double without_pull(const Row &row, const double u)
    {
      if (!std::isnan(row.open))
        return std::max(u, row.open);
      return row.force(u) >= 0.
                 ? u
                 : increasing_root([&](const double at) { return row.force(at); }, 0., row.u0);
    }
  } // namespace

  ConstraintLaws::ConstraintLaws(const Constraints &constraints) : constraints(constraints)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const ForceLaw *law = constraints[i].spring.law.get();
      if (!law && constraints[i].spring.conserving)
      {
        using Points = std::vector<std::pair<double, double>>;
        linear.push_back(std::make_shared<TableLaw>(Points{{1., constraints[i].spring.stiffness}}));
        law = linear.back().get();
      }
      if (law)
        rows.push_back({i, law});
    }
    row_of.assign(constraints.size(), rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      row_of[rows[r].index] = r;
    has_some = constraints.any(!rows.empty());
  }

  double ConstraintLaws::Row::mean_force(const double u) const
  {
    if (!conserving || (u >= 0. && u0 >= 0.))
      return law->mean_force(u0, u);
    if (u <= 0. && u0 <= 0.)
      return 0.;
    return law->energy(std::max(u, u0)) / std::fabs(u - u0);
  }

  double ConstraintLaws::Row::slope_of_mean(const double u) const
  {
    const double difference = u - u0;
    if (conserving && u <= 0.)
      return u0 > 0. ? -mean_force(u) / difference : 0.;
    if (std::fabs(difference) > least_difference * std::max(std::fabs(u), std::fabs(u0)))
      return (law->force(u) - mean_force(u)) / difference;
    return .5 * law->stiffness(.5 * (u + u0));
  }

  double ConstraintLaws::Row::force(const double u) const
  {
    const double damped = conserving ? std::max(0., u) - std::max(0., undamped) : u - undamped;
    return at_end * law->force(u) + (of_mean > 0. ? of_mean * mean_force(u) : 0.) +
           damping * damped;
  }

  double ConstraintLaws::Row::slope(const double u) const
  {
    double of_law = at_end * law->stiffness(u);
    if (of_mean > 0.)
      of_law += of_mean * slope_of_mean(u);
    const double least = conserving ? least_slope_of_conserving : least_slope;
    return std::max(of_law, least * law->largest_stiffness()) +
           (conserving && u < 0. ? 0. : damping);
  }

  void ConstraintLaws::begin(const std::size_t i, Row row, const double low, const double high)
  {
    row.open = increasing_root([&](const double u) { return row.force(u); }, low, high);
    rows[row_of[i]] = row;
  }

  void ConstraintLaws::begin_at_end(const std::size_t i, const double u, const double damping,
                                    const double undamped)
  {
    Row row{i, rows[row_of[i]].law, u};
    row.damping = damping;
    row.undamped = undamped;
    begin(i, row, std::min(0., undamped), std::max(0., undamped));
  }

  void ConstraintLaws::begin_mean(const std::size_t i, const double u, const double theta,
                                  const double damping)
  {
    Row row{i, rows[row_of[i]].law, u};
    row.at_end = (2. * theta - 1.) / theta;
    row.of_mean = 2. * (1. - theta) / theta;
    row.damping = damping;
    row.undamped = u;
    begin(i, row, -std::fabs(u), std::fabs(u));
  }

  void ConstraintLaws::begin_conserving(const std::size_t i, const double u, const double damping)
  {
    Row row = rows[row_of[i]];
    row.u0 = row.undamped = u;
    row.at_end = 0.;
    row.of_mean = 2.;
    row.damping = damping;
    row.conserving = true;
    row.open = 0.;
    if (u > 0.)
    {
      // Below 0 the mean is W(u_0) / (u_0 - u), and the force of the damper stays.
      row.open = damping > 0. ? u - row.of_mean * row.law->energy(u) / (damping * u)
                              : -std::numeric_limits<double>::infinity();
      if (row.open > 0.)
        row.open = std::numeric_limits<double>::quiet_NaN(); // see without_pull()
    }
    rows[row_of[i]] = row;
  }

  double ConstraintLaws::lack(const std::size_t i, const double u, const double L) const
  {
    if (row_of[i] == rows.size())
      return 0.;
    const Row &row = rows[row_of[i]];
    // A force below zero is rounding, which the cone of the constraint is measured by.
    return (constraints[i].cone.project(L) - row.force(u)) / row.slope(u);
  }

  void ConstraintLaws::set_compressions(const std::vector<double> &gap,
                                        std::vector<double> &result) const
  {
    result.clear();
    for (const Row &row : rows)
      result.push_back(without_pull(row, -gap[row.index]));
  }

  double ConstraintLaws::relaxed(const std::size_t i, const double u) const
  {
    return without_pull(rows[row_of[i]], u);
  }

  double ConstraintLaws::polished(const std::size_t i, const double u, const double L) const
  {
    // Newton's method from the end of a search takes a few; the bound ends one that goes to and
    // fro.
    constexpr int most = 100;
    constexpr double rounding = 1e-15;
    double result = u;
    for (int iteration = 0; iteration < most; ++iteration)
    {
      const double change = lack(i, result, L);
      result += change;
      if (!(std::fabs(change) > rounding * std::fabs(result)))
        break;
    }
    return result;
  }

  void ConstraintLaws::linearise(const std::vector<double> &u, std::vector<double> &S,
                                 std::vector<double> &shift) const
  {
    for (std::size_t r = 0; r < rows.size(); ++r)
    {
      const std::size_t i = rows[r].index;
      S[i] = 1. / rows[r].slope(u[r]);
      shift[i] = u[r] - S[i] * rows[r].force(u[r]);
    }
  }

  /// Largest residual of a law over the terms of its gap. For conserving laws, whose slope varies
  /// by orders of magnitude, also the residual force.
  ConstraintLaws::Error ConstraintLaws::error(const Point &at,
                                              const MixedComplementarityProblem &problem,
                                              const ComplementarityOperator &F)
  {
    std::vector<double> &u = in_error;
    set_compressions(at.gap, u);
    Error result;
    double &largest = result.gap;
    for (std::size_t r = 0; r < rows.size(); ++r)
    {
      const std::size_t i = rows[r].index;
      const double lacking = std::fabs(lack(i, u[r], at.multiplier[i])),
                   terms = std::fabs(problem.free_gap[i]) + problem.gap_scale[i] +
                           F.diagonal(i) * std::fabs(at.multiplier[i]),
                   relative = lacking == 0. ? 0. : lacking / terms;
      if (!(relative <= largest) && !std::isnan(largest))
        largest = relative;
      if (rows[r].conserving && lacking > 0.)
        result.force = std::max(result.force, std::fabs(at.multiplier[i] - rows[r].force(u[r])) *
                                                  F.diagonal(i) / terms);
    }
    result.gap = constraints.max(result.gap);
    result.force = constraints.max(result.force);
    return result;
  }

  /// Derivative of the energy by s, at the part s of the way.
  double ConstraintLaws::slope_of_energy(const Point &from, const Point &to, const double s,
                                         const std::vector<double> &S) const
  {
    double sum = 0.;
    for (const std::size_t i : constraints.rows_but_cuts()) // cuts do not move
    {
      if (!constraints.counts(i))
        continue;
      const double change = to.gap[i] - from.gap[i], gap = from.gap[i] + s * change,
                   L = (1. - s) * from.multiplier[i] + s * to.multiplier[i];
      // The gap of a rigid constraint that stays closed is rounding, but its force is not.
      if (row_of[i] == rows.size() && S[i] == 0. && std::fabs(change) <= known_to * scale[i])
        continue;
      double of_spring = 0.;
      if (row_of[i] < rows.size())
        of_spring = std::max(0., rows[row_of[i]].force(-gap));
      else if (S[i] > 0.)
        of_spring = constraints[i].cone.project(-gap / S[i]);
      sum += change * (L - of_spring);
    }
    return constraints.added_up(sum);
  }

  /// Moves the end of the way to the least energy, unless the energy has certainly decreased: its
  /// derivative grows along the way.
  void ConstraintLaws::shorten(const Point &from, Point &to, const std::vector<double> &S) const
  {
    const auto slope = [&](const double part) { return slope_of_energy(from, to, part, S); };
    if (!(slope(.5) + slope(1.) > 0.))
      return;
    const double s = increasing_root(slope, 0., 1.);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      to.gap[i] = from.gap[i] + s * (to.gap[i] - from.gap[i]);
      to.multiplier[i] = from.multiplier[i] + s * (to.multiplier[i] - from.multiplier[i]);
    }
  }

  const MixedComplementaritySolution &
  ConstraintLaws::solve(MixedComplementarityProblem &problem, StepEquations &system,
                        const StepCheck &check, Residuals &residuals, std::vector<double> &S,
                        std::vector<double> &shift)
  {
    std::vector<double> &gap = free_gap, &u = compression;
    gap = problem.free_gap;
    scale = problem.gap_scale;
    u.clear();
    // For a conserving constraint, start where slopes only fall.
    for (const Row &row : rows)
      u.push_back(without_pull(row, row.conserving ? -gap[row.index] : row.u0));
    const MixedComplementaritySolution *solution = nullptr;
    Error before = {std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
    unsigned int iterations = 0;
    for (int iteration = 0; iteration < most_linearisations; ++iteration)
    {
      linearise(u, S, shift);
      for (const Row &row : rows)
      {
        problem.free_gap[row.index] = gap[row.index] + shift[row.index];
        problem.gap_scale[row.index] = scale[row.index] + std::fabs(shift[row.index]);
      }
      system.set_compliance(S);
      solution = &system.find_multipliers(problem, check, residuals);
      residuals.iterations = iterations += residuals.iterations;
      now.multiplier = solution->multiplier;
      now.gap = solution->gap;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        now.gap[i] -= S[i] * now.multiplier[i] + (has(i) ? shift[i] : 0.);
      const ComplementarityOperator &F = system.interface().matrix();
      const Error found = error(now, problem, F);
      if (found.gap <= converged ||
          (found.gap <= stagnated && found.gap >= not_closer * before.gap &&
           found.force >= not_closer * before.force))
        break;
      if (iteration > 0)
        shorten(last, now, S);
      before = error(now, problem, F);
      std::swap(last, now);
      set_compressions(last.gap, u);
    }
    // An open constraint has its law at rest. The residuals measures the residuals of the others.
    for (const Row &row : rows)
      if (solution->multiplier[row.index] == 0. && !std::isinf(row.open))
      {
        shift[row.index] = std::isnan(row.open) ? without_pull(row, 0.) : row.open;
        problem.free_gap[row.index] = gap[row.index] + shift[row.index];
      }
    return *solution;
  }
} // namespace taut
