// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the complementarity solvers solve 10 000 generated problems. Source: residuals computed
// here, from the raw matrix and in long double. The seed is printed; TAUT_SEED sets another one.
#include "common.h"
#include "complementarity_reference.h"

#include "complementarity/solver.h"

namespace
{
  using namespace taut;
  using Vector = std::vector<double>;

  // A tenth of them without optimisation, which makes them ten times slower.
#ifdef NDEBUG
  constexpr unsigned int n_problems = 10000;
#else
  constexpr unsigned int n_problems = 1000;
#endif

  unsigned int seed()
  {
    static const unsigned int value = []
    {
      const char *const text = std::getenv("TAUT_SEED");
      const unsigned int number = text ? std::strtoul(text, nullptr, 10) : 2026;
      std::cout << "TAUT_SEED=" << number << std::endl;
      return number;
    }();
    return value;
  }

  enum class Kind
  {
    random,       ///< F = V^T V with small integers, random gaps
    random_touch, ///< the same with a known solution, N_i = D_i = 0 in some rows, exactly
    string_touch, ///< contacts on a string, the same
    redundant,    ///< V has fewer rows than columns, or equal columns
    string,       ///< contacts on a string, random gaps
    beam,         ///< contacts within 0.4 m of a beam of 50 m, and some further away
    cycling       ///< 3x3 blocks on which a plain active set cycles, among random rows
  };

  struct Problem
  {
    Kind kind = Kind::random;
    std::size_t n = 0;
    Vector F; ///< n x n
    Vector V; ///< m x n with F = V^T V, or empty
    MixedComplementarityProblem values;
    bool touches = false;      ///< N_i = D_i = 0 in some row
    bool is_redundant = false; ///< columns of V depend on each other

    void multiply()
    {
      F.assign(n * n, 0.);
      for (std::size_t k = 0; k < V.size(); k += n)
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; V[k + i] != 0. && j < n; ++j)
            F[i * n + j] += V[k + i] * V[k + j];
    }

    void scale_row(std::size_t i, double factor)
    {
      for (std::size_t k = i; k < V.size(); k += n)
        V[k] *= factor;
      for (std::size_t j = 0; j < n; ++j)
      {
        F[i * n + j] *= factor;
        F[j * n + i] *= factor;
      }
    }

    DenseOperator matrix() const
    {
      DenseOperator result(n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          result.set(i, j, F[i * n + j]);
      return result;
    }
  };

  class Generator
  {
  public:
    explicit Generator(unsigned int index) : random(1000003ull * seed() + index)
    {
      static const Kind kinds[] = {Kind::random,       Kind::random,    Kind::random_touch,
                                   Kind::string_touch, Kind::redundant, Kind::redundant,
                                   Kind::string,       Kind::beam,      Kind::cycling,
                                   Kind::random_touch};
      problem.kind = kinds[index % 10];
    }

    Problem generate()
    {
      const double size = uniform();
      problem.n = 1 + std::size_t(200 * size * size * size);
      choose_matrix();
      if (problem.kind != Kind::cycling)
        add_inert_rows();
      choose_gaps();
      if (integer(2))
        scale_rows();
      return problem;
    }

    double uniform() { return std::uniform_real_distribution<double>(0., 1.)(random); }
    int integer(int n) { return random() % n; }

  private:
    void choose_matrix()
    {
      const double fractions[] = {0., 0., uniform(), uniform(), 1.};
      const double bilateral = fractions[integer(5)];
      if (problem.kind == Kind::string || problem.kind == Kind::string_touch)
        set_string();
      else if (problem.kind == Kind::beam)
        set_beam();
      else
        set_product();
      for (std::size_t i = 0; i < problem.n; ++i)
        problem.values.cones.push_back(taut::Cone::unilateral_if(uniform() >= bilateral));
      if (problem.kind == Kind::cycling)
        set_cycling_blocks();
    }

    /// F = V^T V with entries -3..3, half of them 0, above a unit matrix if F is to be definite.
    void set_product()
    {
      const std::size_t n = problem.n;
      const bool is_redundant = problem.kind == Kind::redundant;
      const bool has_few_rows = is_redundant && integer(2);
      const std::size_t m = has_few_rows ? 1 + std::size_t(.8 * n * uniform()) : n + 2 + integer(n);
      problem.V.resize(m * n);
      problem.is_redundant = m < n;
      for (double &entry : problem.V)
        entry = integer(2) ? integer(7) - 3 : 0;
      if (!is_redundant)
        problem.V.resize((m + n) * n, 0.);
      for (std::size_t i = 0; !is_redundant && i < n; ++i)
        problem.V[(m + i) * n + i] = 1.;
      if (is_redundant && !has_few_rows)
        for (std::size_t copies = 1 + integer(n); copies > 0; --copies)
        {
          const std::size_t from = integer(n), to = integer(n);
          const int factor = integer(2) ? 1 : 2 * (integer(2) - 2);
          problem.is_redundant |= from != to;
          for (std::size_t k = 0; k < m; ++k)
            problem.V[k * n + to] = factor * problem.V[k * n + from];
        }
      problem.multiply();
    }

    /// F_ij = compliance(x, y) of the lower and the upper one of two places.
    template <typename Compliance>
    void set_compliance(const Vector &places, const Compliance &compliance)
    {
      for (const double a : places)
        for (const double b : places)
          problem.F.push_back(compliance(std::min(a, b), std::max(a, b)));
    }

    /// A string with held ends: x (1 - y), at different multiples of 1/1024.
    void set_string()
    {
      Vector places(1023);
      std::iota(places.begin(), places.end(), 1.);
      std::shuffle(places.begin(), places.end(), random);
      places.resize(problem.n);
      set_compliance(places, [](double x, double y) { return x / 1024. * (1. - y / 1024.); });
    }

    /// A simply supported beam of unit length: (1 - y) x (2 y - x^2 - y^2) / 6.
    void set_beam()
    {
      const std::size_t n_near = 2 + integer(7);
      const std::size_t n = problem.n = n_near + integer(12);
      Vector places(n);
      for (std::size_t i = 0; i < n; ++i)
        if (i < n_near)
          places[i] = .5 + .4 / 50. * (i + uniform() / 2.) / n_near;
        else
          places[i] = integer(2) ? .45 * uniform() : 1. - .45 * uniform();
      set_compliance(places, [](double x, double y)
                     { return (1. - y) * x * (2. * y - x * x - y * y) / 6.; });
    }

    /// The first rows become 3x3 blocks; then all rows change places.
    void set_cycling_blocks()
    {
      static const double block[3][3] = {{4, 5, -5}, {5, 9, -5}, {-5, -5, 7}};
      n_block_rows = 3 * (1 + integer(3));
      const std::size_t n = problem.n = std::max(problem.n, n_block_rows);
      set_product();
      problem.V.clear();
      problem.values.cones.resize(n, taut::Cone::half_line());
      for (std::size_t i = 0; i < n_block_rows; ++i)
      {
        problem.values.cones[i] = taut::Cone::half_line();
        for (std::size_t j = 0; j < n; ++j)
          problem.F[i * n + j] = problem.F[j * n + i] = j / 3 == i / 3 ? block[i % 3][j % 3] : 0.;
      }
    }

    void choose_gaps()
    {
      const std::size_t n = problem.n;
      Vector &d = problem.values.free_gap;
      for (std::size_t i = 0; i < n; ++i)
        d.push_back(integer(201) - 100 + uniform());
      if (problem.kind == Kind::random_touch || problem.kind == Kind::string_touch ||
          problem.kind == Kind::redundant)
        set_known_gaps(problem.kind != Kind::redundant || integer(2));
      if (problem.kind == Kind::beam)
        for (double &gap : d)
          gap = uniform() - .5;
      for (std::size_t i = 0; i < n; ++i)
        if (problem.F[i * n + i] == 0.)
          d[i] = problem.values.cones[i].may_open() ? std::abs(d[i]) : 0.;
      static const double cycling[] = {2., 1., -3.};
      const int sign = integer(2) ? 1 : -1;
      for (std::size_t i = 0; i < n_block_rows; ++i)
        d[i] = sign * cycling[i % 3];
      if (problem.kind == Kind::cycling)
        permute();
    }

    /// d = D - F N for small integers N and D: no rounding at all.
    void set_known_gaps(bool touches)
    {
      const std::size_t n = problem.n;
      Vector N(n);
      for (std::size_t i = 0; i < n; ++i)
      {
        const int state = integer(touches ? 3 : 2);
        const bool unilateral = problem.values.cones[i].may_open();
        N[i] = unilateral ? (state == 0 ? 1 + integer(8) : 0) : integer(15) - 7;
        problem.values.free_gap[i] = unilateral && state == 1 ? 1 + integer(8) : 0.;
        problem.touches |= unilateral && state == 2 && problem.F[i * n + i] > 0.;
      }
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          problem.values.free_gap[i] -= problem.F[i * n + j] * N[j];
    }

    void permute()
    {
      const std::size_t n = problem.n;
      std::vector<std::size_t> order(n);
      std::iota(order.begin(), order.end(), 0);
      std::shuffle(order.begin(), order.end(), random);
      const Problem old = problem;
      for (std::size_t i = 0; i < n; ++i)
      {
        problem.values.free_gap[i] = old.values.free_gap[order[i]];
        problem.values.cones[i] = old.values.cones[order[i]];
        for (std::size_t j = 0; j < n; ++j)
          problem.F[i * n + j] = old.F[order[i] * n + order[j]];
      }
    }

    /// Every fifth problem gets rows that nothing moves.
    void add_inert_rows()
    {
      if (integer(5) != 0)
        return;
      for (int count = 1 + integer(3); count > 0; --count)
        problem.scale_row(integer(problem.n), 0.);
    }

    /// Rows by 1e-8 to 1e8, as powers of 2: exact.
    void scale_rows()
    {
      for (std::size_t i = 0; i < problem.n; ++i)
      {
        const double factor = std::ldexp(1., integer(53) - 26);
        problem.values.free_gap[i] *= factor;
        problem.scale_row(i, factor);
      }
    }

    std::mt19937_64 random;
    Problem problem;
    std::size_t n_block_rows = 0;
  };

  /// Largest residual of a row as the library defines it, from the entries of F in long double.
  double raw_residual(const Problem &problem, const MixedComplementaritySolution &solution)
  {
    const std::size_t n = problem.n;
    double largest = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      long double gap = problem.values.free_gap[i], terms = std::abs(gap);
      for (std::size_t j = 0; j < n; ++j)
      {
        const long double term = (long double)(problem.F[i * n + j]) * solution.multiplier[j];
        gap += term;
        terms += std::abs(term);
      }
      const long double force = problem.F[i * n + i] * solution.multiplier[i];
      const long double violation = problem.values.cones[i].may_open() ? std::min(force, gap) : gap;
      const long double error = std::max(std::abs(violation), std::abs(gap - solution.gap[i]));
      if (!(error <= largest * terms))
        largest = error / terms;
    }
    return largest;
  }

  std::string describe(unsigned int index, const Problem &problem)
  {
    return "problem " + std::to_string(index) + ", kind " + std::to_string(int(problem.kind)) +
           ", " + std::to_string(problem.n) + " rows";
  }

  SemismoothNewton::Outcome run_newton(const Problem &problem,
                                       const ComplementarityOptions &options)
  {
    DenseOperator F = problem.matrix();
    MixedComplementaritySolution solution;
    return SemismoothNewton(options).solve(problem.values, F, solution);
  }

  TEST(complementarity_generated, all_problems_are_solved)
  {
    unsigned int n_touching = 0, n_redundant = 0, n_fallbacks = 0, n_iterations = 0, n_repeats = 0;
    double largest = 0.;
    for (unsigned int index = 0; index < n_problems; ++index)
    {
      const Problem problem = Generator(index).generate();
      DenseOperator F = problem.matrix();
      ComplementaritySolver solver;
      try
      {
        const ComplementarityResult &result = solver.solve(problem.values, F);
        const double residual = raw_residual(problem, result.solution);
        EXPECT_LE(residual, 1e-10) << describe(index, problem);
        largest = std::max(largest, residual);
        n_fallbacks += result.used_fallback;
        n_iterations += result.iterations;
        n_repeats += solver.solve(problem.values, F).iterations > 1;
      }
      catch (const std::exception &error)
      {
        ADD_FAILURE() << describe(index, problem) << ": " << error.what();
      }
      n_touching += problem.touches;
      n_redundant += problem.is_redundant;
    }
    std::cout << n_touching << " touch, " << n_redundant << " redundant, " << n_fallbacks
              << " fallbacks, " << n_iterations << " iterations, residual " << largest << "; "
              << n_repeats << " take more than one iteration from their own solution" << std::endl;
    EXPECT_GE(n_touching, n_problems / 10);
    EXPECT_GE(n_redundant, n_problems / 10);
    EXPECT_LE(n_repeats, n_problems / 100);
  }

  /// Changes the energy-ordered active set needs alone; @p largest is raised to the residual.
  std::size_t n_changes_alone(const Problem &problem, const ComplementarityOptions &options,
                              double &largest)
  {
    DenseOperator F = problem.matrix();
    EnergyOrderedActiveSet solver(options);
    MixedComplementaritySolution solution;
    EXPECT_EQ(solver.solve(problem.values, F, solution), EnergyOrderedActiveSet::Outcome::finished);
    const double residual = raw_residual(problem, solution);
    EXPECT_LE(residual, 1e-10);
    largest = std::max(largest, residual);
    return solver.n_changes();
  }

  TEST(complementarity_generated, energy_ordered_active_set_solves_them_alone)
  {
    double largest = 0.;
    for (unsigned int index = 0; index < n_problems; ++index)
    {
      const Problem problem = Generator(index).generate();
      SCOPED_TRACE(describe(index, problem));
      EXPECT_LE(n_changes_alone(problem, ComplementarityOptions(), largest), 6 * problem.n);
    }
    std::cout << "residual " << largest << std::endl;
  }

  TEST(complementarity_generated, energy_ordered_active_set_ends_without_a_dead_band)
  {
    // Rounding lets rows in and throws them out again; they have to wait, or it would never end.
    ComplementarityOptions no_band;
    no_band.dead_band = 0.;
    unsigned int n_long = 0;
    double largest = 0.;
    for (unsigned int index = 0; index < n_problems; ++index)
    {
      const Problem problem = Generator(index).generate();
      if (!problem.touches || problem.n > 80)
        continue;
      SCOPED_TRACE(describe(index, problem));
      n_long += n_changes_alone(problem, no_band, largest) > 6 * problem.n;
    }
    EXPECT_LE(n_long, n_problems / 1000);
  }

  /// Gaps are unique, multipliers where the rows without gap are independent, V N always.
  void expect_same(const Problem &problem, const MixedComplementaritySolution &solution,
                   const reference::Solution &expected)
  {
    // Each row in its own unit, the root of F_ii; relative to the largest gap and multiplier.
    const std::size_t n = problem.n;
    reference::Vector root;
    reference::scaled(problem.F, n, root);
    long double size = 0.;
    for (std::size_t i = 0; i < n; ++i)
      size = std::max({size, std::abs(problem.values.free_gap[i]) / root[i],
                       std::abs(expected.N[i]) * root[i]});
    std::vector<std::size_t> shut;
    for (std::size_t i = 0; i < n; ++i)
    {
      EXPECT_LE(std::abs(solution.gap[i] - expected.D[i]) / root[i], 1e-9 * size) << "gap " << i;
      if (problem.F[i * n + i] > 0. && expected.D[i] / root[i] <= 1e-8 * size)
        shut.push_back(i);
    }
    if (!(reference::smallest_pivot(problem.F, n, shut) > 1e-5))
      shut.clear();
    for (const std::size_t i : shut)
      EXPECT_LE(std::abs(solution.multiplier[i] - expected.N[i]) * root[i], 1e-8 * size)
          << "multiplier " << i;
    long double difference = 0., terms = 0.;
    for (std::size_t k = 0; k * n < problem.V.size(); ++k)
    {
      long double sum = 0.;
      for (std::size_t i = 0; i < n; ++i)
      {
        sum += problem.V[k * n + i] * (solution.multiplier[i] - expected.N[i]);
        terms = std::max(terms, std::abs(problem.V[k * n + i] * expected.N[i]));
      }
      difference = std::max(difference, std::abs(sum));
    }
    EXPECT_LE(difference, 1e-7 * terms) << "V N";
  }

  TEST(complementarity_generated, independent_methods_agree)
  {
    unsigned int n_compared = 0;
    for (unsigned int index = 0; index < n_problems; ++index)
    {
      const Problem problem = Generator(index).generate();
      if (problem.n > 60)
        continue;
      SCOPED_TRACE(describe(index, problem));
      const reference::Solution expected = reference::solve(problem.values, problem.F);
      EXPECT_TRUE(expected.found);
      DenseOperator F = problem.matrix();
      for (const char *const method : {"semismooth Newton", "MPRGP"})
      {
        SCOPED_TRACE(method);
        ComplementaritySolver solver(method);
        expect_same(problem, solver.solve(problem.values, F).solution, expected);
      }
      ++n_compared;
    }
    std::cout << n_compared << " compared" << std::endl;
  }

  TEST(complementarity_generated, cycling_problems_need_the_guard)
  {
    // Without the guard they go round to the iteration bound; with it, the fallback takes over.
    ComplementarityOptions unguarded;
    unguarded.detect_cycles = false;
    unsigned int n_guarded = 0, n_unguarded = 0, n = 0;
    for (unsigned int index = 0; index < n_problems; ++index)
    {
      const Problem problem = Generator(index).generate();
      if (problem.kind != Kind::cycling || problem.n > 50)
        continue;
      ++n;
      n_guarded +=
          run_newton(problem, ComplementarityOptions()) == SemismoothNewton::Outcome::cycle;
      n_unguarded += run_newton(problem, unguarded) == SemismoothNewton::Outcome::max_iterations;
    }
    std::cout << n_guarded << " of " << n << " cycle" << std::endl;
    EXPECT_GE(n, n_problems / 100);
    EXPECT_EQ(n_guarded, n);
    EXPECT_EQ(n_unguarded, n);
  }

  TEST(complementarity_generated, exact_touch_needs_the_dead_band)
  {
    ComplementarityOptions no_band;
    no_band.dead_band = 0.;
    unsigned int n = 0, n_failures = 0, n_failures_without = 0;
    for (unsigned int index = 0; index < n_problems; ++index)
    {
      const Problem problem = Generator(index).generate();
      if (!problem.touches || problem.is_redundant)
        continue;
      ++n;
      n_failures +=
          run_newton(problem, ComplementarityOptions()) != SemismoothNewton::Outcome::solved;
      n_failures_without += run_newton(problem, no_band) != SemismoothNewton::Outcome::solved;
    }
    std::cout << n << " touch: Newton fails in " << n_failures << " with dead band, in "
              << n_failures_without << " without" << std::endl;
    EXPECT_GE(n, n_problems / 10);
    EXPECT_LE(n_failures, n / 500);
    EXPECT_GE(n_failures_without, n / 10);
  }

  TEST(complementarity_generated, contradictory_pairs_are_named)
  {
    // Two rows of one motion, d_j = f d_i +- 1: bilateral, or opposite stops that leave no room.
    for (unsigned int index = 0; index < 500; ++index)
    {
      Generator generator(n_problems + index);
      const std::size_t n = 2 + generator.integer(20);
      const std::size_t i = generator.integer(n - 1), j = i + 1 + generator.integer(n - 1 - i);
      const bool bilateral = generator.integer(2);
      const double factor = bilateral ? 2. : -2.;
      DenseOperator F(n);
      const auto source = [&](std::size_t row) { return row == j ? i : row; };
      const auto scale = [&](std::size_t row) { return row == j ? factor : 1.; };
      const auto entry = [](std::size_t a, std::size_t b)
      { return a == b ? 2. : 1. / (1. + a + b); };
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b <= a; ++b)
          F.set(a, b, scale(a) * scale(b) * entry(source(a), source(b)));
      MixedComplementarityProblem problem;
      for (std::size_t row = 0; row < n; ++row)
      {
        problem.cones.push_back(
            taut::Cone::unilateral_if(row == i || row == j ? !bilateral : generator.integer(2)));
        problem.free_gap.push_back(generator.integer(9) - 4);
      }
      problem.free_gap[j] = factor * problem.free_gap[i] - 1.;
      for (const char *const method : {"semismooth Newton", "energy-ordered", "MPRGP"})
        try
        {
          ComplementaritySolver(method).solve(problem, F);
          ADD_FAILURE() << "no exception in problem " << index;
        }
        catch (const ContradictoryRows &error)
        {
          EXPECT_EQ(error.rows(), (std::vector<std::size_t>{i, j})) << "problem " << index;
        }
    }
  }

  /// A floating problem with a known solution: d = D - F N - G^T alpha, e = -G N, in small
  /// integers. With @p resisted about half of the null space vectors have a resistance E, the
  /// others an explicit zero, and e = E alpha - G N.
  Problem generate_floating(unsigned int index, bool resisted = false)
  {
    Generator generator(2 * n_problems + index);
    Problem problem;
    const std::size_t n = problem.n = 1 + generator.integer(40);
    const std::size_t m = generator.integer(2 * n), n_null_space = 1 + generator.integer(3);
    problem.V.resize(m * n);
    for (double &entry : problem.V)
      entry = generator.integer(7) - 3;
    problem.multiply();
    MixedComplementarityProblem &values = problem.values;
    Vector G(n_null_space * n);
    for (double &entry : G)
      entry = generator.integer(5) - 2;
    values.null_space = mode_equations(n, G);
    values.null_space_load.assign(n_null_space, 0.);
    Vector N(n), alpha(n_null_space);
    for (double &amplitude : alpha)
      amplitude = generator.integer(9) - 4;
    for (std::size_t i = 0; i < n; ++i)
    {
      const int state = generator.integer(3);
      values.cones.push_back(taut::Cone::unilateral_if(generator.integer(4) > 0));
      N[i] = values.cones[i].may_open() ? (state == 0 ? 1 + generator.integer(8) : 0)
                                        : generator.integer(15) - 7;
      values.free_gap.push_back(values.cones[i].may_open() && state == 1 ? 1 + generator.integer(8)
                                                                         : 0.);
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t j = 0; j < n; ++j)
        values.free_gap[i] -= problem.F[i * n + j] * N[j];
      for (std::size_t k = 0; k < n_null_space; ++k)
      {
        values.free_gap[i] -= G[k * n + i] * alpha[k];
        values.null_space_load[k] -= G[k * n + i] * N[i];
      }
    }
    for (std::size_t k = 0; resisted && k < n_null_space; ++k)
    {
      values.null_space_resistance.push_back(generator.integer(2) * (1 + generator.integer(8)));
      values.null_space_load[k] += values.null_space_resistance[k] * alpha[k];
    }
    return problem;
  }

  TEST(complementarity_generated, floating_bodies_are_balanced)
  {
    unsigned int n_fallbacks = 0;
    double largest = 0.;
    for (unsigned int index = 0; index < 1000; ++index)
      for (const char *const method : {"semismooth Newton", "energy-ordered", "MPRGP"})
      {
        const Problem problem = generate_floating(index);
        DenseOperator F = problem.matrix();
        ComplementaritySolver solver(method);
        try
        {
          const ComplementarityResult &result = solver.solve(problem.values, F);
          n_fallbacks += result.used_fallback;
          largest = std::max(largest, result.residual.max);
        }
        catch (const std::exception &error)
        {
          ADD_FAILURE() << method << ", " << describe(index, problem) << ": " << error.what();
        }
      }
    std::cout << n_fallbacks << " fallbacks, residual " << largest << std::endl;
    EXPECT_LE(n_fallbacks, 300u);
  }

  TEST(complementarity_generated, mprgp_solves_them_by_products)
  {
    // Claim: products with F alone find the gaps of nearly all of them, cycling, redundant and
    // touching ones as well, with floating bodies and without; the rest is left to the other
    // methods, which are told so.
    unsigned int n = 0, n_found = 0, n_cycling = 0, n_found_cycling = 0, n_floating = 0;
    double largest = 0.;
    for (unsigned int index = 0; index < n_problems / 10; ++index)
      for (const bool is_floating : {false, true})
      {
        const Problem problem =
            is_floating ? generate_floating(index, index % 2) : Generator(index).generate();
        DenseOperator F = problem.matrix();
        Mprgp solver;
        MixedComplementaritySolution solution;
        const bool is_found = solver.solve(problem.values, F, solution);
        if (is_found)
        {
          largest = std::max(largest, solver.residual().max);
          EXPECT_LE(solver.residual().max, 1e-6) << describe(index, problem);
        }
        const bool is_cycling = !is_floating && problem.kind == Kind::cycling;
        ++n;
        n_found += is_found;
        n_cycling += is_cycling;
        n_found_cycling += is_cycling && is_found;
        n_floating += is_floating && is_found;
      }
    std::cout << n_found << " of " << n << " found, " << n_found_cycling << " of " << n_cycling
              << " cycling, " << n_floating << " floating, residual " << largest << std::endl;
    EXPECT_GE(n_found, n - n / 20);
    EXPECT_EQ(n_found_cycling, n_cycling);
  }

  TEST(complementarity_generated, mprgp_leaves_rows_out_that_take_no_part)
  {
    // Of two rows that would share -3 m, one takes no part: the other carries it alone.
    DenseOperator F(2);
    F.set(0, 0, 2.);
    F.set(1, 0, 1.);
    F.set(1, 1, 2.);
    MixedComplementarityProblem problem;
    problem.cones = {Cone::half_line(), Cone::zero()};
    problem.free_gap = {-3., -3.};
    Mprgp solver;
    MixedComplementaritySolution solution;
    ASSERT_TRUE(solver.solve(problem, F, solution));
    EXPECT_NEAR(solution.multiplier[0], 1.5, 1e-8);
    EXPECT_EQ(solution.multiplier[1], 0.);
    EXPECT_LE(solver.residual().max, 1e-8);
  }

  TEST(complementarity_generated, mprgp_keeps_its_rate)
  {
    // Source: the bound of the rate with the eigenvalues of a circulant, 1 - 2 c cos(2 pi k / n),
    // whose diagonal is 1. A change takes two products at most.
    constexpr std::size_t n = 40;
    constexpr double error = 1e-9;
    for (const double c : {.1, .3, .45, .49})
    {
      DenseOperator F(n);
      for (std::size_t i = 0; i < n; ++i)
      {
        F.set(i, i, 1.);
        F.set(std::max(i, (i + 1) % n), std::min(i, (i + 1) % n), -c);
      }
      MixedComplementarityProblem problem;
      Generator generator(static_cast<unsigned int>(1e3 * c));
      for (std::size_t i = 0; i < n; ++i)
      {
        problem.cones.push_back(Cone::unilateral_if(i % 5 > 0));
        problem.free_gap.push_back(generator.integer(19) - 9.5);
      }
      const double least = 1. - 2. * c, norm = 1. + 2. * c,
                   rate = 1. - .1 * least / (4. * 1.9 * 1.1 * norm),
                   bound = 2. * std::log(error * error * least / norm) / std::log(rate);
      Mprgp solver;
      MixedComplementaritySolution solution;
      ASSERT_TRUE(solver.solve(problem, F, solution));
      std::cout << "condition " << norm / least << ": " << solver.n_products() << " products, "
                << solver.n_changes() << " changes, bound " << bound << std::endl;
      EXPECT_LE(solver.n_products(), 21. + bound);
      EXPECT_LE(solver.n_products(), 40. + 6. * std::sqrt(norm / least));
      EXPECT_GT(solver.n_changes(), 0u);
      EXPECT_LE(solver.residual().max, 1e-8);
    }
  }

  TEST(complementarity_generated, energy_ordered_active_set_takes_any_resistance)
  {
    // Claim: alone, on all resistances, half of them or none of them zero, it finds what Newton's
    // method finds: residual below 1e-10, and the resisted amplitudes, which are unique.
    double largest = 0., difference = 0.;
    unsigned int n_zero = 0, n_mixed = 0, n_compared = 0;
    for (unsigned int index = 0; index < 1000; ++index)
    {
      const Problem problem = generate_floating(index, true);
      const Vector &E = problem.values.null_space_resistance;
      const auto zeros = std::count(E.begin(), E.end(), 0.);
      n_zero += zeros == long(E.size());
      n_mixed += zeros > 0 && zeros < long(E.size());
      DenseOperator F = problem.matrix();
      EnergyOrderedActiveSet solver{ComplementarityOptions()};
      MixedComplementaritySolution solution, newton;
      SCOPED_TRACE(describe(index, problem));
      ASSERT_EQ(solver.solve(problem.values, F, solution),
                EnergyOrderedActiveSet::Outcome::finished);
      EXPECT_LE(solver.residual().max, 1e-10);
      largest = std::max(largest, solver.residual().max);
      newton.closed.assign(problem.n, 1);
      if (SemismoothNewton(ComplementarityOptions()).solve(problem.values, F, newton) !=
          SemismoothNewton::Outcome::solved)
        continue;
      ++n_compared;
      for (std::size_t k = 0; k < E.size(); ++k)
        if (E[k] > 0.)
          difference =
              std::max(difference, std::abs(solution.mode_amplitude[k] - newton.mode_amplitude[k]));
    }
    std::cout << n_zero << " without resistance, " << n_mixed << " mixed, " << n_compared
              << " compared, residual " << largest << ", difference of amplitudes " << difference
              << std::endl;
    EXPECT_GT(n_zero, 100u);
    EXPECT_GT(n_mixed, 100u);
    EXPECT_GT(n_compared, 800u);
    EXPECT_LE(difference, 1e-8); // of up to 4
  }
} // namespace
