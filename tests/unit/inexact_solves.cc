// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: with an operator that iterates, Newton's method solves roughly while the active set
// changes and exactly once it stays, from the multipliers it has; the answer is that of a direct
// operator. Expected: the direct answer, fewer inner iterations than with exact solves throughout,
// and fewer still from the multipliers of a neighbouring problem. A set that comes back because it
// was solved roughly before is no cycle.
#include "common.h"

#include "base/dot.h"
#include "complementarity/solver.h"

namespace
{
  using Vector = std::vector<double>;

  class IteratingOperator : public taut::ComplementarityOperator
  {
  public:
    explicit IteratingOperator(const taut::DenseOperator &F) : F(F) {}

    std::size_t size() const override { return F.size(); }
    double diagonal(std::size_t i) const override { return F.diagonal(i); }
    void apply(const Vector &x, Vector &y) const override { F.apply(x, y); }
    void apply_absolute(const Vector &x, Vector &y) const override { F.apply_absolute(x, y); }
    bool is_iterative() const override { return true; }
    void set_tolerance(double value) override { tolerance = std::max(value, smallest); }

    bool solve(const std::vector<std::size_t> &set, const Vector &rhs, double shift,
               Vector &x) override
    {
      tolerances.push_back(tolerance);
      const std::size_t n = F.size();
      x.assign(n, 0.);
      Vector r(n, 0.), p(n, 0.), q;
      for (const std::size_t i : set)
        r[i] = rhs[i];
      const double start = taut::dot(r, r);
      double rr = start, last = 1.;
      for (int i = 0; i < 1000 && rr > tolerance * tolerance * start; ++i, ++n_iterations)
      {
        for (const std::size_t k : set)
          p[k] = r[k] + (i > 0 ? rr / last : 0.) * p[k];
        F.apply(p, q);
        double curvature = 0.;
        for (const std::size_t k : set)
        {
          q[k] += shift * F.diagonal(k) * p[k];
          curvature += p[k] * q[k];
        }
        for (const std::size_t k : set)
        {
          x[k] += rr / curvature * p[k];
          r[k] -= rr / curvature * q[k];
        }
        last = std::exchange(rr, taut::dot(r, r));
      }
      return true;
    }

    static constexpr double smallest = 1e-14;
    std::vector<double> tolerances;
    int n_iterations = 0;
    double tolerance_to_come() const { return tolerance; }

  private:
    const taut::DenseOperator &F;
    double tolerance = smallest;
  };

  /// A string of n nodes over stops at all of them, F its flexibility, pressed down at both ends
  /// and lifted between: from a cold start the set moves for several iterations.
  struct String
  {
    taut::DenseOperator F;
    taut::MixedComplementarityProblem problem;

    explicit String(const std::size_t n, const double lift = 1.) : F(n)
    {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          F.set(i, j, (j + 1.) * (n - i) / (n + 1.) + (i == j ? 1. : 0.));
      Vector load(n);
      for (std::size_t i = 0; i < n; ++i)
        load[i] = std::cos(9. * i / n) * lift - .2;
      problem.cones.assign(n, taut::Cone::half_line());
      F.apply(load, problem.free_gap);
    }
  };
} // namespace

TEST(InexactSolves, end_at_the_answer_of_direct_ones_with_less_work)
{
  String string(80);
  taut::ComplementaritySolver direct;
  const Vector expected = direct.solve(string.problem, string.F).solution.multiplier;
  const double largest = *std::max_element(expected.begin(), expected.end());
  ASSERT_GT(largest, 0.);
  IteratingOperator rough(string.F), exact(string.F);
  taut::ComplementaritySolver solver;
  const taut::ComplementarityResult &result = solver.solve(string.problem, rough);
  EXPECT_GT(result.iterations, 2u);
  EXPECT_FALSE(result.used_fallback);
  EXPECT_LT(verification::largest_difference(expected, result.solution.multiplier),
            1e-10 * largest);
  taut::ComplementarityOptions options;
  options.inexact_tolerance = options.linear_tolerance;
  taut::ComplementaritySolver always_exact("semismooth Newton", options);
  always_exact.solve(string.problem, exact);
  EXPECT_LT(rough.n_iterations, .7 * exact.n_iterations);
  // Roughly first, exactly last, and so do those that come after the search.
  EXPECT_GE(rough.tolerances.front(), 1e-6);
  EXPECT_LE(*std::min_element(rough.tolerances.begin(), rough.tolerances.end()), 1e-8);
  EXPECT_EQ(rough.tolerance_to_come(), IteratingOperator::smallest);
}

TEST(InexactSolves, start_from_the_last_multipliers)
{
  const String first(80), second(80, 1. + 1e-6);
  IteratingOperator F(first.F), cold(first.F);
  taut::ComplementaritySolver solver, other;
  solver.solve(first.problem, F);
  solver.solve(first.problem, F); // its set stays: from now on exact at once
  F.n_iterations = 0;
  const taut::ComplementarityResult &result = solver.solve(second.problem, F);
  EXPECT_EQ(result.iterations, 1u);
  other.start_from(result.solution.closed);
  other.solve(second.problem, cold);
  EXPECT_LT(F.n_iterations, .8 * cold.n_iterations);
}

namespace
{
  /// Two rows, the second of which has a small multiplier that rough solves miss.
  class MissingOperator : public taut::DenseOperator
  {
  public:
    MissingOperator() : DenseOperator(2)
    {
      set(0, 0, 1.);
      set(1, 1, 1.);
      set(1, 0, .5);
    }
    bool is_iterative() const override { return true; }
    void set_tolerance(double value) override { tolerance = value; }
    bool solve(const std::vector<std::size_t> &rows, const Vector &rhs, double shift,
               Vector &x) override
    {
      const bool is_solved = DenseOperator::solve(rows, rhs, shift, x);
      if (tolerance > 1e-8 && rows.size() == 2)
        x[1] -= missed;
      return is_solved;
    }

    static constexpr double missed = 3e-4;

  private:
    double tolerance = 0.;
  };
} // namespace

TEST(InexactSolves, sets_of_rough_solves_are_no_cycle)
{
  // Of these, rough solves see the open gap of the larger one, and not that of the smaller one.
  for (const double small : {1e-6, 2e-4})
  {
    MissingOperator F;
    taut::MixedComplementarityProblem problem;
    problem.cones.assign(2, taut::Cone::half_line());
    F.apply({-1., -small}, problem.free_gap);
    taut::ComplementaritySolver solver;
    const taut::ComplementarityResult &result = solver.solve(problem, F);
    EXPECT_FALSE(result.used_fallback);
    EXPECT_NEAR(result.solution.multiplier[0], 1., 1e-12);
    EXPECT_NEAR(result.solution.multiplier[1], small, 1e-12);
  }
}
