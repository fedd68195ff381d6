// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the complementarity solvers solve small problems exactly. Source: answers found by hand.
#include "common.h"
#include "complementarity_reference.h"

#include "complementarity/energy_ordered.h"
#include "complementarity/solver.h"
#include "complementarity/whole_problem.h"

#include <new>
#include <type_traits>

namespace
{
  std::size_t n_allocations = 0;
}

[[gnu::noinline]] void *operator new(std::size_t size)
{
  ++n_allocations;
  if (void *const memory = std::malloc(size == 0 ? 1 : size))
    return memory;
  throw std::bad_alloc();
}

/// Of temporary buffers of the library; the sanitizers' own would not fit the operators below.
[[gnu::noinline]] void *operator new(std::size_t size, const std::nothrow_t &) noexcept
{
  ++n_allocations;
  return std::malloc(size == 0 ? 1 : size);
}

[[gnu::noinline]] void operator delete(void *memory) noexcept
{
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void *memory, std::size_t) noexcept
{
  std::free(memory);
}

namespace
{
  using namespace taut;
  using Vector = std::vector<double>;

  const std::vector<std::string> both_methods = {"semismooth Newton", "energy-ordered"};

  DenseOperator dense(const std::vector<Vector> &rows)
  {
    DenseOperator matrix(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        matrix.set(i, j, rows[i][j]);
    return matrix;
  }

  MixedComplementarityProblem problem(const std::vector<char> &unilateral, const Vector &free_gap)
  {
    MixedComplementarityProblem result;
    for (const char is_unilateral : unilateral)
      result.cones.push_back(taut::Cone::unilateral_if(is_unilateral));
    result.free_gap = free_gap;
    return result;
  }

  void expect_near(const Vector &a, const Vector &b, double tolerance = 1e-12)
  {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i], b[i], tolerance) << "entry " << i;
  }

  ComplementarityResult solved(const std::string &method, const MixedComplementarityProblem &values,
                               DenseOperator F, const std::vector<char> &start = {})
  {
    ComplementaritySolver solver(method);
    solver.start_from(start);
    return solver.solve(values, F);
  }

  class CountingOperator : public ComplementarityOperator
  {
  public:
    explicit CountingOperator(DenseOperator matrix) : matrix(std::move(matrix)) {}

    std::size_t size() const override { return matrix.size(); }
    double diagonal(std::size_t i) const override { return matrix.diagonal(i); }
    void apply(const Vector &x, Vector &y) const override
    {
      ++n_products;
      matrix.apply(x, y);
    }
    void apply_absolute(const Vector &x, Vector &y) const override
    {
      ++n_absolute_products;
      matrix.apply_absolute(x, y);
    }
    bool solve(const std::vector<std::size_t> &set, const Vector &rhs, double shift,
               Vector &x) override
    {
      ++n_solves;
      if (!matrix.solve(set, rhs, shift, x))
        return false;
      for (double &value : x)
        value *= 1. + solve_error;
      return true;
    }

    DenseOperator matrix;
    double solve_error = 0.; ///< relative, of each solve
    unsigned int n_solves = 0;
    mutable unsigned int n_products = 0, n_absolute_products = 0;
  };

  /// -u'' with unit load at the nodes of a held string, inverted: min(x,y) (1 - max(x,y)).
  DenseOperator string_compliance(std::size_t n)
  {
    DenseOperator matrix(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        matrix.set(i, j, (j + 1.) / (n + 1.) * (1. - (i + 1.) / (n + 1.)));
    return matrix;
  }

  const std::vector<Vector> cycling_matrix = {{4, 5, -5}, {5, 9, -5}, {-5, -5, 7}};

  /// Both methods find the answer by hand, from all rows open, from all closed and without a start.
  void expect_solved(const std::string &claim, const std::vector<Vector> &matrix,
                     const MixedComplementarityProblem &values, const Vector &multiplier,
                     const Vector &gap, const double multiplier_tolerance = 1e-12,
                     const double gap_tolerance = 1e-12, const Vector &mode_amplitude = {},
                     const double amplitude_tolerance = 1e-12, const bool takes_fallback = false)
  {
    for (const std::string &method : both_methods)
      for (const auto &start : {std::vector<char>(), std::vector<char>(matrix.size(), 0),
                                std::vector<char>(matrix.size(), 1)})
      {
        SCOPED_TRACE(claim + ", " + method);
        const auto result = solved(method, values, dense(matrix), start);
        expect_near(result.solution.multiplier, multiplier, multiplier_tolerance);
        expect_near(result.solution.gap, gap, gap_tolerance);
        if (!mode_amplitude.empty())
          expect_near(result.solution.mode_amplitude, mode_amplitude, amplitude_tolerance);
        EXPECT_TRUE(!start.empty() || takes_fallback || !result.used_fallback);
        for (std::size_t i = 0; i < matrix.size(); ++i)
          EXPECT_TRUE((multiplier[i] == 0. && gap[i] == 0.) ||
                      bool(result.solution.closed[i]) == (multiplier[i] != 0.))
              << "row " << i;
      }
  }

  /// The rows, or the null space vectors, that are named as what cannot be met or held.
  template <typename Error>
  std::vector<std::size_t> refused(const std::string &method, const std::vector<Vector> &matrix,
                                   const MixedComplementarityProblem &values)
  {
    try
    {
      solved(method, values, dense(matrix));
    }
    catch (const Error &error)
    {
      if constexpr (std::is_same_v<Error, BodyNotHeld>)
        return error.null_space();
      else
        return error.rows();
    }
    ADD_FAILURE() << "no exception";
    return {};
  }

  /// @p values with bodies that move by the null space vectors @p G.
  MixedComplementarityProblem floating(MixedComplementarityProblem values, const Vector &G,
                                       const Vector &load, const Vector &resistance = {})
  {
    values.null_space = mode_equations(values.size(), G);
    values.null_space_load = load;
    values.null_space_resistance = resistance;
    return values;
  }

  TEST(complementarity, small_problems_have_the_answers_found_by_hand)
  {
    // Claim: one row on a spring of compliance 2 m/N.
    expect_solved("an open gap carries nothing", {{2.}}, problem({1}, {3.}), {0.}, {3.}, 0., 0.);
    expect_solved("a violated gap is pushed shut", {{2.}}, problem({1}, {-3.}), {1.5}, {0.}, 8e-16,
                  1e-15);
    expect_solved("a bilateral row pulls as well", {{2.}}, problem({0}, {3.}), {-1.5}, {0.}, 8e-16);
    // With F = [2 1; 1 2] and both rows closed N = -F^-1 d = -(2 d0 - d1, 2 d1 - d0) / 3.
    std::vector<Vector> F = {{2., 1.}, {1., 2.}};
    // Row 0 alone takes N = 2 and lifts row 1 from -1 to +1.
    expect_solved("a neighbour opens a row whose free gap is violated", F,
                  problem({1, 1}, {-4., -1.}), {2., 0.}, {0., 1.});
    // Bilateral row 0 pulls with -2 and draws row 1 from 1 to -1, which has to close.
    expect_solved("bilateral and unilateral rows mix", F, problem({0, 1}, {4., 1.}),
                  {-7. / 3., 2. / 3.}, {0., 0.});
    // The same motion, gaps -1 and -2: only the second touches, N = 2, and the first is open by 1.
    expect_solved("the tighter of two parallel stops carries", {{1., 1.}, {1., 1.}},
                  problem({1, 1}, {-1., -2.}), {0., 2.}, {1., 0.});
    // F = B^T B with columns (1,0), (0,1), (.6,.6). By energy row 0 closes, then row 1: N = (10, 3,
    // 0), which leaves D_2 = -.2. z = (-.6, -.6, 1) is a null vector; N_1 gets to zero first. {0,
    // 2}: det .36, N = (2.4, 0, 2) / .36.
    expect_solved("a dependent row is exchanged along the null direction",
                  {{1., 0., .6}, {0., 1., .6}, {.6, .6, .72}}, problem({1, 1, 1}, {-10., -3., -8.}),
                  {20. / 3., 0., 50. / 9.}, {0., 1. / 3., 0.});
    expect_solved("rows without stiffness are dropped", {{2., 0., 0.}, {0., 0., 0.}, {0., 0., 0.}},
                  problem({1, 1, 0}, {-4., 7., 0.}), {2., 0., 0.}, {0., 7., 0.});
    // Row 1 alone: N = 3/2; row 0 would close.
    F = {{2., -1.}, {-1., 2.}};
    auto one_of_two = problem({1, 1}, {-1., -3.});
    expect_solved("both rows close", F, one_of_two, {5. / 3., 7. / 3.}, {0., 0.});
    one_of_two.cones[0] = taut::Cone::zero();
    expect_solved("a row held open takes no part", F, one_of_two, {0., 1.5}, {-2.5, 0.}, 8e-16);
  }

  TEST(complementarity, no_rows_are_a_solved_problem)
  {
    for (const std::string &method : both_methods)
      EXPECT_EQ(solved(method, problem({}, {}), DenseOperator(0)).residual.max, 0.);
  }

  TEST(complementarity, exact_touch_keeps_the_row_as_it_was)
  {
    // N = D = 0 in row 1: N_0 = 2, D_1 = 2 - 2. Both sets are solutions.
    for (const char start : {0, 1})
    {
      const auto result = solved("semismooth Newton", problem({1, 1}, {-4., -2.}),
                                 dense({{2., 1.}, {1., 2.}}), {1, start});
      expect_near(result.solution.multiplier, {2., 0.});
      EXPECT_EQ(result.solution.closed[1], start);
      EXPECT_EQ(result.iterations, 1u);
    }
  }

  TEST(complementarity, dead_band_holds_a_row_that_is_off_by_rounding)
  {
    // The touch of the last test with D_1 = -4e-16 in it.
    DenseOperator F = dense({{2., 1.}, {1., 2.}});
    const auto touching = problem({1, 1}, {-4., std::nextafter(-2., -3.)});
    for (const double dead_band : {1e-12, 0.})
    {
      ComplementarityOptions options;
      options.dead_band = dead_band;
      MixedComplementaritySolution solution;
      solution.closed = {1, 0};
      SemismoothNewton newton(options);
      newton.solve(touching, F, solution);
      EXPECT_EQ(newton.n_iterations() == 1, dead_band > 0.);
    }
  }

  TEST(complementarity, gap_scale_widens_the_dead_band)
  {
    // d = 1000.0 - 1000.0 + noise: a gap of -1e-11 m between coordinates of 1000 m is none.
    auto noise = problem({1}, {-1e-11});
    const auto force = [&]
    { return solved("semismooth Newton", noise, dense({{1.}})).solution.multiplier[0]; };
    EXPECT_GT(force(), 0.);
    noise.gap_scale = {1000.};
    EXPECT_EQ(force(), 0.);
  }

  TEST(complementarity, cycling_3x3_is_solved)
  {
    // d = (2,1,-3): rows 0 and 2 closed, F_aa = [4 -5; -5 7], det 3, N = (1/3, 0, 2/3), D_1 = 1 +
    // 5/3 - 10/3 = -2/3. That opens nothing but closes 1, and so on round; the one set that holds
    // is {1, 2}: [9 -5; -5 7], det 38, N = (0, 8, 22) / 38, D_0 = 2 + 40/38 - 110/38 = 6/38. d =
    // -(2,1,-3): {0}, N_0 = 1/2, D = (0, 3/2, 1/2).
    const std::vector<Vector> multipliers = {{0., 8. / 38., 22. / 38.}, {.5, 0., 0.}};
    const std::vector<Vector> gaps = {{6. / 38., 0., 0.}, {0., 1.5, .5}};
    for (const std::string &method : both_methods)
      for (int start = 0; start < 8; ++start)
        for (const int sign : {1, -1})
        {
          const auto result =
              solved(method, problem({1, 1, 1}, {2. * sign, 1. * sign, -3. * sign}),
                     dense(cycling_matrix), {char(start & 1), char(start & 2), char(start & 4)});
          expect_near(result.solution.multiplier, multipliers[sign == 1 ? 0 : 1]);
          expect_near(result.solution.gap, gaps[sign == 1 ? 0 : 1]);
        }
  }

  TEST(complementarity, a_cycle_is_seen_at_its_first_return)
  {
    // Newton's method alone cycles from 6 of the 8 starts, or ends at the iteration bound.
    unsigned int n_cycles = 0;
    for (int start = 0; start < 8; ++start)
    {
      DenseOperator F = dense(cycling_matrix);
      const auto cycling = problem({1, 1, 1}, {2., 1., -3.});
      MixedComplementaritySolution solution;
      const std::vector<char> closed = {char(start & 1), char(start & 2), char(start & 4)};
      ComplementarityOptions options;
      SemismoothNewton guarded(options);
      solution.closed = closed;
      const auto outcome = guarded.solve(cycling, F, solution);
      if (outcome == SemismoothNewton::Outcome::solved)
        continue;
      ++n_cycles;
      EXPECT_EQ(outcome, SemismoothNewton::Outcome::cycle);
      EXPECT_LT(guarded.n_iterations(), 8u);
      options.detect_cycles = false;
      SemismoothNewton unguarded(options);
      solution.closed = closed;
      EXPECT_EQ(unguarded.solve(cycling, F, solution), SemismoothNewton::Outcome::max_iterations);
    }
    EXPECT_EQ(n_cycles, 6u);
  }

  TEST(complementarity, duplicate_rows_share_the_force_evenly)
  {
    // Any split is a solution, even or not; the gaps are unique.
    for (const std::string &method : both_methods)
      for (const char unilateral : {0, 1})
      {
        const auto result = solved(method, problem({unilateral, unilateral, 1}, {-4., -4., 5.}),
                                   dense({{2., 2., 1.}, {2., 2., 1.}, {1., 1., 3.}}));
        const Vector &N = result.solution.multiplier;
        expect_near(result.solution.gap, {0., 0., 7.});
        if (method == "energy-ordered")
          expect_near({N[0] + N[1]}, {2.}, 1e-14);
        else
          expect_near(N, {1., 1., 0.}, 1e-7);
        EXPECT_TRUE(!result.used_fallback || method == "energy-ordered");
      }
  }

  TEST(complementarity, the_row_that_releases_most_energy_closes_first)
  {
    // Alone, the rows release d^2/(2 F): 1/2 and 1/200. The first one opens the second, and that is
    // all; with the second one first, it would close, the other one too, and it would open again.
    DenseOperator F = dense({{1., .9}, {.9, 1.}});
    EnergyOrderedActiveSet solver{ComplementarityOptions()};
    MixedComplementaritySolution solution;
    EXPECT_EQ(solver.solve(problem({1, 1}, {-1., -.1}), F, solution),
              EnergyOrderedActiveSet::Outcome::finished);
    expect_near(solution.multiplier, {1., 0.});
    expect_near(solution.gap, {0., .8});
    EXPECT_EQ(solver.n_changes(), 1u);
  }

  TEST(complementarity, rows_that_contradict_each_other_are_named)
  {
    const auto both = std::vector<std::size_t>{1, 2};
    for (const std::string &method : both_methods)
    {
      SCOPED_TRACE(method);
      EXPECT_EQ(refused<ContradictoryRows>(method, {{3., 0., 0.}, {0., 1., 1.}, {0., 1., 1.}},
                                           problem({0, 0, 0}, {1., -1., -1.001})),
                both);
      // A wedge between the stops u - 1 >= 0 and -u - 1 >= 0 of one motion u, apart from row 0.
      EXPECT_EQ(refused<ContradictoryRows>(method, {{3., 0., 0.}, {0., 1., -1.}, {0., -1., 1.}},
                                           problem({1, 1, 1}, {-1., -1., -1.})),
                both);
      // A violated row that nothing moves.
      for (const char unilateral : {0, 1})
        EXPECT_EQ(refused<ContradictoryRows>(method, {{2., 0.}, {0., 0.}},
                                             problem({1, unilateral}, {-4., -7.})),
                  std::vector<std::size_t>{1});
      // A mass tied to two places at once; the third row is its neighbour's.
      EXPECT_EQ(refused<ContradictoryRows>(
                    method, {{0., 0., 0.}, {0., 0., 0.}, {0., 0., 1.}},
                    floating(problem({0, 0, 1}, {-1., -2., -1.}), {1., 1., 0.}, {-3.})),
                (std::vector<std::size_t>{0, 1}));
    }
  }

  // Claim: bilateral rows that repeat others get the multipliers of least norm, whatever the sizes
  // of F, also beside rows that open. Expected: with B = (1 0; 0 1; 1 2; 3 0) the last row opens,
  // and z = (1, 2, -1) is across N with B N = -(F of the two motions)^-1 u.
  TEST(complementarity, rows_that_repeat_others_have_the_least_multipliers)
  {
    const double B[4][2] = {{1., 0.}, {0., 1.}, {1., 2.}, {3., 0.}}, u[2] = {.3, -.7};
    for (const std::string method : {"semismooth Newton", "energy-ordered"})
      for (const double softness : {1., 1e-6, 1e6})
      {
        DenseOperator F(4);
        const double A[2] = {softness, 7. * softness};
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j <= i; ++j)
            F.set(i, j, B[i][0] * A[0] * B[j][0] + B[i][1] * A[1] * B[j][1]);
        MixedComplementarityProblem all;
        all.cones = {Cone::free(), Cone::free(), Cone::free(), Cone::half_line()};
        for (const auto &row : B)
          all.free_gap.push_back(row[0] * u[0] + row[1] * u[1]);
        all.free_gap[3] += 1.;
        ComplementaritySolver solver(method);
        for (int repetition = 0; repetition < 2; ++repetition)
        {
          const std::vector<double> N = solver.solve(all, F).solution.multiplier;
          EXPECT_NEAR(A[0] * (N[0] + N[2]), -u[0], 1e-12);
          EXPECT_NEAR(A[1] * (N[1] + 2. * N[2]), -u[1], 1e-12);
          EXPECT_NEAR(softness * (N[0] + 2. * N[1] - N[2]), 0., 1e-12);
          EXPECT_EQ(N[3], 0.);
        }
        EXPECT_EQ(solver.repeated_rows().partners(1), (std::vector<std::size_t>{0, 1, 2}));
        EXPECT_TRUE(solver.repeated_rows().partners(3).empty());
      }
  }

  TEST(complementarity, contradictory_rows_are_not_hidden_by_a_coarse_tolerance_of_the_solves)
  {
    // Multipliers of 1e9 make any gap small compared with F N: growth must be seen, too.
    ComplementarityOptions options;
    options.dead_band = options.linear_tolerance = options.tolerance = 1e-6;
    DenseOperator F = dense({{1., 1.}, {1., 1.}});
    ComplementaritySolver solver("semismooth Newton", options);
    EXPECT_THROW(solver.solve(problem({0, 0}, {-1., -1.01}), F), ContradictoryRows);
  }

  // ---- floating bodies: a beam on stops at x = 0, 1, 2 that moves by alpha_0 + alpha_1 x

  const std::vector<Vector> rigid(3, Vector(3, 0.));
  const std::vector<Vector> elastic = {{1e-3, 0., 0.}, {0., 1e-3, 0.}, {0., 0., 1e-3}};

  MixedComplementarityProblem beam_on_stops(double load, double position, const Vector &gaps)
  {
    return floating(problem({1, 1, 1}, gaps), {1., 1., 1., 0., 1., 2.}, {-load, -load * position});
  }

  TEST(complementarity, rigid_beam_and_other_bodies_are_held_as_found_by_hand)
  {
    // Springs of 1 m/kN: N_i = P/3 + P (x - 1) (x_i - 1) / 2 if none pulls; else the lever of two.
    expect_solved("a rigid beam spreads its load over elastic stops", elastic,
                  beam_on_stops(12., 1.25, {0., 0., 0.}), {2.5, 4., 5.5}, {0., 0., 0.}, 1e-12,
                  1e-12, {-2.5e-3, -1.5e-3}, 1e-15);
    expect_solved("a rigid beam lifts off one of its elastic stops", elastic,
                  beam_on_stops(10., 1.7, {0., 0., 0.}), {0., 3., 7.}, {1e-3, 0., 0.}, 1e-12,
                  1e-15);
    // F = 0. Stop 0 is 1 mm lower: the beam tilts onto 0 and 1 and lifts off 2 by the lever 2 / 1.
    expect_solved("a rigid beam finds the two rigid stops that hold it", rigid,
                  beam_on_stops(10., .3, {1e-3, 0., 0.}), {7., 3., 0.}, {0., 0., 1e-3}, 1e-12,
                  1e-15, {-1e-3, 1e-3}, 1e-15, true);
    // By hand: N = 10 from the second balance, 2 alpha_0 = N - 4, alpha_1 = -.1 N - .5 - alpha_0.
    expect_solved(
        "E_k = 0 is a null space vector that contacts alone balance, beside a resisted one", {{.1}},
        floating(problem({1}, {.5}), {1., 1.}, {-4., -10.}, {2., 0.}), {10.}, {0.}, 1e-12, 1e-12,
        {3., -4.5});
    // A free rod of stiffness 1 with both ends on stops, loads -1 and -2, pseudo-inverse with end 0
    // held: F = diag(0,1), d = (0, -2), G = (1 1), e = -3. Each end carries its own load at rest.
    for (const char unilateral : {0, 1})
      expect_solved("a singular pseudo-inverse does no harm", {{0., 0.}, {0., 1.}},
                    floating(problem({unilateral, unilateral}, {0., -2.}), {1., 1.}, {-3.}),
                    {1., 2.}, {0., 0.}, 1e-12, 1e-12, {}, 0., true);
  }

  TEST(complementarity, a_touching_row_may_be_what_holds_a_body)
  {
    // Made from N = (0, -3, 0, 0, -5, 0), D = (0, 0, 2, 3, 0, 5), alpha = (1, 3, 0). Without row 0,
    // which touches, one motion is free: the method of multipliers alone is off by some 1e-7 N.
    const std::vector<Vector> F = {{19., 6., 14., 2., -15., -11.},  {6., 10., 7., -2., -12., 0.},
                                   {14., 7., 14., -1., -12., -4.},  {2., -2., -1., 2., 0., -4.},
                                   {-15., -12., -12., 0., 19., 7.}, {-11., 0., -4., -4., 7., 11.}};
    const Vector G = {-1., -1., -2., -2., 0., -2., -2., -1., 0.,
                      2.,  -1., 2.,  -2., 1., -1., -1., -2., 0.};
    expect_solved("a touching row may be what holds a body", F,
                  floating(problem({1, 0, 1, 1, 0, 1}, {-50., -26., -35., -7., 62., 36.}), G,
                           {-3., -8., -7.}),
                  {0., -3., 0., 0., -5., 0.}, {0., 0., 2., 3., 0., 5.}, 1e-11, 1e-9, {}, 0., true);
  }

  TEST(complementarity, rigid_beam_rests_on_stops_without_any_gap)
  {
    // d = F = 0: nothing gives rounding a scale. N is not unique, its balance is.
    for (const std::string &method : both_methods)
      for (const double position : {0., .3, 1., 2.})
      {
        const auto result =
            solved(method, beam_on_stops(10., position, {0., 0., 0.}), DenseOperator(3));
        const Vector &N = result.solution.multiplier;
        EXPECT_NEAR(N[0] + N[1] + N[2], 10., 1e-12);
        EXPECT_NEAR(N[1] + 2. * N[2], 10. * position, 1e-12);
        expect_near(result.solution.gap, {0., 0., 0.}, 1e-15);
      }
  }

  TEST(complementarity, a_soft_spring_does_not_hide_the_gaps_of_stiff_ones)
  {
    // Claim: a platform of 10 N stands on springs of 1 mm/N, the second 2 mm lower, and is pushed
    // up with 2 N by one that is 1e12 times as soft: the others carry 5 N and 3 N. That the first
    // one carries all leaves a gap of -6 mm, which is no rounding of the 2e9 m of the soft one.
    const auto platform = floating(problem({1, 1, 1}, {0., 2e-3, -2e9}), {1., 1., 1.}, {-10.});
    const DenseOperator F = dense({{1e-3, 0., 0.}, {0., 1e-3, 0.}, {0., 0., 1e9}});
    MixedComplementaritySolution wrong = {{8., 0., 2.}, {}, {-8e-3}, {}};
    gaps(platform, F, wrong.multiplier, wrong.mode_amplitude, wrong.gap);
    EXPECT_GT(residual(platform, F, wrong).rows[1], .1);
    for (const std::string &method : both_methods)
    {
      const auto result = solved(method, platform, F);
      expect_near(result.solution.multiplier, {5., 3., 2.}, 1e-9);
      expect_near(result.solution.mode_amplitude, {-5e-3});
    }
  }

  TEST(complementarity, bodies_that_are_not_held_are_named)
  {
    const auto two = [](const Vector &gaps, const Vector &load, const Vector &resistance) {
      return floating(problem({1, 1}, gaps), {1., 0., 0., 1.}, load, resistance);
    };
    const std::vector<Vector> F(2, Vector(2, 0.));
    const std::vector<std::size_t> second = {1};
    for (const std::string &method : both_methods)
    {
      // A beam that is loaded beyond its stops.
      for (const auto &stops : {rigid, elastic})
        EXPECT_FALSE(
            refused<BodyNotHeld>(method, stops, beam_on_stops(10., 2.5, {0., 0., 0.})).empty());
      // Two masses on a stop each; the second is pulled off.
      EXPECT_EQ(refused<BodyNotHeld>(method, F, two({0., 0.}, {-5., 5.}, {})), second);
      // The first of two bodies falls, and the second, which nothing resists, is lifted.
      EXPECT_EQ(refused<BodyNotHeld>(method, F, two({.1, .2}, {-5., 7.}, {100., 0.})), second);
    }
    // The first falls 5 / 100 of its gap of 0.1, the second stands with its load of 7.
    expect_solved("a body that nothing resists stands beside one that falls", F,
                  two({.1, .2}, {-5., -7.}, {100., 0.}), {0., 7.}, {.05, 0.}, 1e-12, 1e-12,
                  {-.05, -.2}, 1e-12, true);
  }

  TEST(complementarity, resistances_that_are_zero_are_as_none)
  {
    // Claim: explicit zeros are the same problem to the last bit; the rigid beam of above.
    for (const std::string &method : both_methods)
    {
      auto beam = beam_on_stops(10., .3, {1e-3, 0., 0.});
      const auto none = solved(method, beam, DenseOperator(3)).solution;
      beam.null_space_resistance = {0., 0.};
      const auto zeros = solved(method, beam, DenseOperator(3)).solution;
      EXPECT_EQ(none.multiplier, zeros.multiplier);
      EXPECT_EQ(none.gap, zeros.gap);
      EXPECT_EQ(none.mode_amplitude, zeros.mode_amplitude);
    }
  }

  TEST(complementarity, a_body_without_rows_is_held_only_if_it_has_no_load)
  {
    for (const std::string &method : both_methods)
      for (const std::size_t n : {0, 1})
      {
        const DenseOperator F = dense(std::vector<Vector>(n, {1.}));
        auto loose = problem(std::vector<char>(n, 1), Vector(n, -1.));
        loose.null_space = {{}};
        loose.null_space_load = {0.};
        EXPECT_EQ(solved(method, loose, F).solution.mode_amplitude, Vector{0.});
        loose.null_space_load = {1.};
        EXPECT_THROW(solved(method, loose, F), BodyNotHeld);
      }
  }

  TEST(complementarity, solves_that_are_off_are_corrected)
  {
    // Each correction leaves a hundredth of the gaps: 3 * 100^-k < 6e-12 with k = 6.
    CountingOperator F(dense({{2., 1.}, {1., 2.}}));
    F.solve_error = .01;
    ComplementaritySolver solver("semismooth Newton");
    const auto &result = solver.solve(problem({0, 0}, {-3., -3.}), F);
    expect_near(result.solution.multiplier, {1., 1.}, 2e-12);
    EXPECT_EQ(F.n_solves, 6u);
    EXPECT_EQ(result.iterations, 1u);
  }

  TEST(complementarity, bilateral_rows_alone_take_one_linear_solve)
  {
    CountingOperator F(string_compliance(20));
    ComplementaritySolver solver;
    const auto &result = solver.solve(problem(std::vector<char>(20, 0), Vector(20, 1.)), F);
    EXPECT_EQ(F.n_solves, 1u);
    EXPECT_EQ(result.iterations, 1u);
    EXPECT_LT(result.residual.max, 1e-13);
  }

  TEST(complementarity, a_set_that_is_still_right_takes_one_solve_and_two_products)
  {
    CountingOperator F(string_compliance(20));
    auto touching = problem(std::vector<char>(20, 1), Vector(20, 1.));
    touching.free_gap[5] = touching.free_gap[14] = -1.;
    ComplementaritySolver solver;
    solver.solve(touching, F);
    F.n_solves = F.n_products = F.n_absolute_products = 0;
    touching.free_gap[5] = -1.01;
    EXPECT_EQ(solver.solve(touching, F).iterations, 1u);
    EXPECT_EQ(F.n_solves, 1u);
    EXPECT_EQ(F.n_products, 1u);
    EXPECT_EQ(F.n_absolute_products, 1u);
  }

  TEST(complementarity, a_warm_step_allocates_nothing)
  {
    const std::size_t n = 30;
    DenseOperator F = string_compliance(n);
    auto step = problem(std::vector<char>(n, 1), Vector(n, -1.));
    step.cones[0] = taut::Cone::free();
    ComplementaritySolver solver;
    solver.solve(step, F);
    const std::size_t before = n_allocations;
    for (int i = 0; i < 10; ++i)
    {
      for (std::size_t j = 0; j < n; ++j)
        F.set(n - 1, j, F(n - 1, j) * (j == n - 1 ? 1.01 : .99));
      step.free_gap[3] -= .001;
      solver.solve(step, F);
    }
    EXPECT_EQ(n_allocations, before);
  }

  TEST(complementarity, kept_factor_equals_a_fresh_one)
  {
    // Random sets, orders, shifts and entries; the reference is an operator that has seen no other.
    std::mt19937 random(7);
    const std::size_t n = 12;
    DenseOperator kept(n);
    for (std::size_t i = 0; i < n; ++i)
      kept.set(i, i, 10.);
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    for (int step = 0; step < 500; ++step)
    {
      if (step % 5 == 0)
        std::shuffle(order.begin() + random() % n, order.end(), random);
      for (int change = random() % 3; change > 0; --change)
        kept.set(random() % n, random() % n, 0.);
      for (int change = random() % 3; change > 0; --change)
      {
        const std::size_t i = random() % n, j = random() % n;
        kept.set(i, j, i == j ? 10. + random() % 5 : .1 * (random() % 11) - .5);
      }
      for (std::size_t i = 0; i < n; ++i)
        if (kept(i, i) == 0.)
          kept.set(i, i, 10.);
      const std::vector<std::size_t> set(order.begin(), order.begin() + random() % (n + 1));
      const double shift = random() % 3 == 0 ? .1 * (1 + random() % 2) : 0.;
      Vector rhs(n), x, y;
      std::generate(rhs.begin(), rhs.end(), [&] { return random() % 10; });
      DenseOperator fresh(n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          fresh.set(i, j, kept(i, j));
      ASSERT_TRUE(kept.solve(set, rhs, shift, x));
      ASSERT_TRUE(fresh.solve(set, rhs, shift, y));
      expect_near(x, y, 1e-14);
      kept.apply(x, y);
      for (const std::size_t i : set)
        ASSERT_NEAR(y[i] + shift * kept(i, i) * x[i], rhs[i], 1e-12);
    }
  }

  TEST(complementarity, products_are_those_of_the_full_matrix)
  {
    const DenseOperator F = dense({{2., 0., 0.}, {0., 3., 0.}, {-4., 5., 6.}});
    Vector y;
    F.apply({1., -1., 2.}, y);
    expect_near(y, {-6., 7., 3.});
    F.apply_absolute({1., -1., 2.}, y);
    expect_near(y, {10., 13., 21.});
  }

  TEST(complementarity, dependent_rows_are_refused_at_every_scale)
  {
    for (const double scale : {1e-16, 1., 1e16})
    {
      // Schur complement of the first two rows on the third.
      const double left = 1. / 9. + scale / 9.;
      DenseOperator F =
          dense({{scale, 0., scale / 3.}, {0., 1., 1. / 3.}, {scale / 3., 1. / 3., left}});
      Vector x;
      EXPECT_FALSE(F.solve({0, 1, 2}, {1., 1., 1.}, 0., x));
      EXPECT_TRUE(F.solve({0, 1, 2}, {1., 1., 1.}, 1e-9, x));
      F.set(2, 2, left * (1. + 1e-10));
      EXPECT_TRUE(F.solve({0, 1, 2}, {1., 1., 1.}, 0., x));
      F.set(2, 2, 0.);
      EXPECT_FALSE(F.solve({2}, {1., 1., 1.}, 0., x));
    }
  }

  TEST(complementarity, residual_tells_each_kind_of_error)
  {
    // d = -4, F = 2: N = 2. All numbers relative to |d| + F N.
    const DenseOperator F = dense({{2.}});
    const auto row = [&](char unilateral, double multiplier, double gap)
    {
      const MixedComplementaritySolution guess = {{multiplier}, {gap}, {}, {}};
      return residual(problem({unilateral}, {-4.}), F, guess).rows[0];
    };
    EXPECT_EQ(row(1, 2., 0.), 0.);
    EXPECT_EQ(row(1, 0., 3.), 0.);
    EXPECT_DOUBLE_EQ(row(1, 2., -.8), .1);      // overlaps
    EXPECT_DOUBLE_EQ(row(1, -1., 3.), 2. / 6.); // pulls
    EXPECT_DOUBLE_EQ(row(1, 2., .8), .1);       // pushes from afar
    EXPECT_DOUBLE_EQ(row(0, 2., .8), .1);
    EXPECT_DOUBLE_EQ(row(0, -2., 0.), 0.);
  }

  TEST(complementarity, residual_sees_unbalanced_bodies)
  {
    const MixedComplementaritySolution guess = {{3., 0., 5.}, {0., 0., 0.}, {0., 0.}, {}};
    const auto result = residual(beam_on_stops(10., 1., {0., 0., 0.}), DenseOperator(3), guess);
    EXPECT_GT(result.null_space[0], .05);
    EXPECT_LT(result.null_space[1], 1e-15);
    EXPECT_EQ(result.max, result.null_space[0]);
  }

  TEST(complementarity, residual_without_terms_is_zero_or_infinite)
  {
    const auto of_gap = [](double gap) {
      return residual(problem({1}, {0.}), DenseOperator(1), {{0.}, {gap}, {}, {}}).max;
    };
    EXPECT_EQ(of_gap(0.), 0.);
    EXPECT_EQ(of_gap(-1e-20), std::numeric_limits<double>::infinity());
  }

  TEST(complementarity, not_a_number_is_never_solved)
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::string &method : both_methods)
    {
      DenseOperator F = dense({{2., 1.}, {1., 2.}});
      ComplementaritySolver solver(method);
      EXPECT_THROW(solver.solve(problem({1, 1}, {nan, 1.}), F), NotSolved);
      EXPECT_THROW(solver.solve(problem({0, 1}, {1., nan}), F), NotSolved);
      F.set(0, 1, nan);
      EXPECT_THROW(solver.solve(problem({1, 1}, {-1., -1.}), F), UserError);
    }
  }

  TEST(complementarity, after_an_exception_the_solver_starts_anew)
  {
    DenseOperator F = dense({{1., -1.}, {-1., 1.}});
    ComplementaritySolver solver;
    EXPECT_THROW(solver.solve(problem({1, 1}, {-1., -1.}), F), ContradictoryRows);
    expect_near(solver.solve(problem({1, 1}, {-1., 3.}), F).solution.multiplier, {1., 0.});
  }

  TEST(complementarity, mistakes_are_refused)
  {
    EXPECT_THROW(ComplementaritySolver("Lemke"), UserError);
    DenseOperator F(2);
    ComplementaritySolver solver;
    EXPECT_THROW(solver.solve(problem({1, 1}, {1.}), F), std::invalid_argument);
    EXPECT_THROW(solver.solve(problem({1}, {1.}), F), std::invalid_argument);
    auto three = problem({1, 1}, {1., 1.});
    three.gap_scale = {1.};
    EXPECT_THROW(solver.solve(three, F), std::invalid_argument);
    three.gap_scale.clear();
    three.null_space_load = {1.};
    EXPECT_THROW(solver.solve(three, F), std::invalid_argument);
  }

  TEST(complementarity, any_operator_serves_the_fallback)
  {
    // Not a DenseOperator: the energy-ordered set has to assemble F from products.
    CountingOperator F(dense(cycling_matrix));
    ComplementaritySolver solver;
    const auto &result = solver.solve(problem({1, 1, 1}, {2., 1., -3.}), F);
    EXPECT_TRUE(result.used_fallback);
    expect_near(result.solution.multiplier, {0., 8. / 38., 22. / 38.});
  }

  /// One that tells its entries with an error of 1e-6.
  class RoughEntries : public CountingOperator
  {
  public:
    using CountingOperator::CountingOperator;
    void apply(const Vector &x, Vector &y) const override
    {
      CountingOperator::apply(x, y);
      if (std::count(x.begin(), x.end(), 0.) + 1 == std::ptrdiff_t(x.size()) &&
          *std::max_element(x.begin(), x.end()) == 1.)
        for (double &value : y)
          value *= 1. + 1e-6;
    }
  };

  TEST(complementarity, the_flag_says_which_method_got_to_the_end)
  {
    // Newton's method cycles; the energy-ordered set misses the tolerance, and Newton's ends it.
    for (const std::string method : {"semismooth Newton", "energy-ordered"})
    {
      RoughEntries F(dense(cycling_matrix));
      ComplementaritySolver solver(method);
      const auto &result = solver.solve(problem({1, 1, 1}, {2., 1., -3.}), F);
      EXPECT_EQ(result.used_fallback, method == "energy-ordered");
      expect_near(result.solution.multiplier, {0., 8. / 38., 22. / 38.});
    }
  }

  /// Solves with an error of 1e-5, and after three of them with a worse one or not at all.
  class WorseningOperator : public CountingOperator
  {
  public:
    WorseningOperator(DenseOperator matrix, const bool fails)
        : CountingOperator(std::move(matrix)), fails(fails)
    {
      solve_error = 1e-5;
    }
    bool solve(const std::vector<std::size_t> &set, const Vector &rhs, double shift,
               Vector &x) override
    {
      if (!CountingOperator::solve(set, rhs, shift, x))
        return false;
      if (++n_solved <= 3)
        return true;
      for (const std::size_t i : set)
        x[i] += 1e-6;
      return !fails;
    }

  private:
    const bool fails;
    int n_solved = 0;
  };

  TEST(complementarity, corrections_of_what_is_solved_make_nothing_worse)
  {
    for (const bool fails : {false, true})
    {
      WorseningOperator F(dense({{1, 1}, {1, 1}}), fails);
      MixedComplementaritySolution solution;
      Vector terms;
      const ComplementarityOptions options;
      const auto outcome = ActiveSetSystem(options).solve(
          problem({1, 1}, {-1., -1.}), F, {0, 1}, options.linear_tolerance, solution, terms);
      EXPECT_EQ(outcome, ActiveSetSystem::Outcome::solved);
      EXPECT_GE(F.n_solves, 5u);
      expect_near(solution.multiplier, {.5, .5}, 1e-8);
      expect_near(solution.gap, {0., 0.});
    }
  }

  /// Rows 0 and 1 of three, all of which another rank has, too. It adds what it knows of them.
  class FirstTwoRows : public SharedRows
  {
  public:
    explicit FirstTwoRows(const double of_third) : of_third(of_third) {}

    std::size_t n_of_all() const override { return 3; }
    std::size_t size() const override { return 2; }
    std::size_t number(const std::size_t i) const override { return i; }
    std::size_t index(const std::size_t number) const override
    {
      return number < 2 ? number : elsewhere;
    }
    bool is_own(std::size_t) const override { return true; }
    double max(const double value) const override { return value; }
    void max(Vector &) const override {}
    void sum(Vector &values) const override { values[2] += of_third; }
    void sum_rows(std::initializer_list<Vector *>) const override {}
    void sum_entries(taut::MatrixEntries &, std::size_t) const override {}

  private:
    const double of_third;
  };

  // Claim: rows of other ranks keep their cones in a problem with all rows. Expected: a row of
  // which no rank says that it is free, or may open, takes no part.
  TEST(complementarity, gathered_rows_keep_their_cones)
  {
    MixedComplementarityProblem own = problem({1, 0}, {-1., -1.});
    for (const auto &[of_third, cone] : {std::pair(0., Cone::zero()), std::pair(1., Cone::free())})
    {
      const FirstTwoRows rows(of_third);
      own.shared = &rows;
      const MixedComplementarityProblem all = whole_problem(own);
      ASSERT_EQ(all.cones.size(), 3u);
      EXPECT_TRUE(all.cones[0] == own.cones[0]);
      EXPECT_TRUE(all.cones[1] == own.cones[1]);
      EXPECT_TRUE(all.cones[2] == cone);
    }
  }
} // namespace
