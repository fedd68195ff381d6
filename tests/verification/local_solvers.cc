// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: local solvers solve, whole vectors and columns, for every size of block and with
// constrained unknowns; a matrix that is singular up to rounding is an error, never an answer.
// Sources: the product with the matrix has to give back the right-hand side; a string of equal
// springs is singular if nothing holds its end.
#include "common.h"

#include <taut/substructure/local_solver.h>

using verification::largest_difference;

namespace
{
  constexpr unsigned int n = 41;
  const std::vector<std::string> solver_names = {"block tridiagonal", "sparse direct"};

  /// Sizes of blocks, and what does not couple in them: nothing, z with the plane, or directions.
  struct Blocks
  {
    unsigned int size;
    std::string decoupled = "";
    std::string name() const
    {
      return "blocks of " + std::to_string(size) +
             (decoupled.empty() ? "" : ", " + decoupled + " decoupled");
    }
    bool couple(const unsigned int i, const unsigned int j) const
    {
      return decoupled.empty() || (decoupled == "z" && (i % 3 == 2) == (j % 3 == 2)) ||
             i % 3 == j % 3;
    }
  };
  const std::vector<Blocks> all_blocks = {{1}, {2}, {3}, {4}, {6}, {6, "z"}, {6, "directions"}};

  using Vector = std::vector<double>;

  /// Numbers between -1 and 1.
  class Numbers
  {
  public:
    explicit Numbers(const unsigned int seed) : random(seed) {}
    double operator()() { return value(random); }
    Vector operator()(const std::size_t n)
    {
      Vector result(n);
      std::generate(result.begin(), result.end(), [&] { return value(random); });
      return result;
    }

    /// A matrix with random blocks, made definite by its diagonal.
    std::unique_ptr<taut::SymmetricMatrix> matrix(const Blocks &blocks, const unsigned int n_nodes)
    {
      const unsigned int b = blocks.size;
      auto result = taut::make_block_tridiagonal(b, b * n_nodes);
      for (unsigned int i = 0; i < b * n_nodes; ++i)
        for (unsigned int j = i / b == 0 ? 0 : b * (i / b - 1); j <= i; ++j)
          if (blocks.couple(i, j))
            result->add(i, j, i == j ? 4. * b : value(random));
      return result;
    }

  private:
    std::mt19937 random;
    std::uniform_real_distribution<double> value{-1., 1.};
  };

  /// Springs of 1 N/m between n points, the first point on a spring of k.
  std::unique_ptr<taut::SymmetricMatrix> string(const double k)
  {
    auto matrix = taut::make_block_tridiagonal(1, n);
    matrix->add(0, 0, k);
    for (unsigned int i = 0; i + 1 < n; ++i)
    {
      matrix->add(i, i, 1.);
      matrix->add(i + 1, i + 1, 1.);
      matrix->add(i + 1, i, -1.);
    }
    return matrix;
  }
} // namespace

TEST(LocalSolvers, hold_what_is_held)
{
  for (const std::string &name : solver_names)
  {
    const auto matrix = string(.5);
    const auto solver = taut::make_local_solver(name, *matrix);
    solver->factor({{1., matrix.get()}}, {});
    // 1 N at the far end stretches every spring by 1 m, and the first one by 2 m.
    Vector x(n, 0.);
    x.back() = 1.;
    solver->solve(x);
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_NEAR(x[i], 2. + i, 1e-11) << name;
  }
}

// Random blocks, made definite by their diagonals; three unknowns are held at zero. Columns decay
// long before the ends, so that those of the block solver come from its recurrences.
TEST(LocalSolvers, products_give_back_what_was_solved)
{
  Numbers value(1);
  constexpr unsigned int n_nodes = 201;
  for (const Blocks &blocks : all_blocks)
    for (const std::string &name : solver_names)
    {
      SCOPED_TRACE(name + ", " + blocks.name());
      const unsigned int b = blocks.size, size = b * n_nodes;
      const auto matrix = value.matrix(blocks, n_nodes);
      const std::vector<unsigned int> held = {0, b * (n_nodes / 2) + 2 % b, size - 1};
      const auto solver = taut::make_local_solver(name, *matrix);
      solver->factor({{.5, matrix.get()}, {1.5, matrix.get()}}, held);
      const auto check = [&](Vector x, const Vector &rhs)
      {
        Vector product(size, 0.);
        matrix->vmult_add(2., x.data(), product.data());
        for (const unsigned int dof : held)
        {
          EXPECT_EQ(x[dof], 0.);
          product[dof] = rhs[dof];
        }
        EXPECT_LT(largest_difference(rhs, product), 1e-12);
      };
      const Vector rhs = value(size);
      Vector x = rhs;
      solver->solve(x);
      check(x, rhs);

      for (unsigned int node = 0; node + 1 < n_nodes; ++node)
      {
        taut::LinearForm form;
        Vector load(size, 0.);
        for (unsigned int i = b * node; i < b * (node + 2); ++i)
          form.add(i, load[i] = value());
        taut::WindowedVector column;
        solver->column(form, column);
        EXPECT_TRUE(name == "sparse direct" || column.value.size() < size);
        Vector full(size, 0.);
        std::copy(column.value.begin(), column.value.end(), full.begin() + column.first);
        check(full, load);
      }

      // All pairs of rows near and far, with unknowns that repeat, are shared, are held.
      std::vector<taut::LinearForm> forms(21);
      std::vector<const taut::LinearForm *> rows;
      for (unsigned int r = 0; r < forms.size(); ++r)
      {
        const unsigned int first = b * (r * r % (n_nodes - 1));
        for (const unsigned int i : {first, first + 2 * b - 1, first})
          forms[r].add(i, value());
        rows.push_back(&forms[r]);
      }
      Vector F;
      solver->flexibilities(rows, F);
      ASSERT_EQ(F.size(), forms.size() * (forms.size() + 1) / 2);
      for (std::size_t i = 0, entry = 0; i < forms.size(); ++i)
      {
        Vector solution(size, 0.);
        forms[i].add_to(1., solution);
        solver->solve(solution);
        EXPECT_NEAR(solver->flexibility(forms[i]), forms[i].dot(solution), 1e-14);
        for (std::size_t j = 0; j <= i; ++j, ++entry)
          EXPECT_NEAR(F[entry], forms[j].dot(solution), 1e-14) << i << ", " << j;
      }
    }
}

// Elements that repeat themselves, but for two nodes: products with the repetitions found are those
// with each entry read, whole or by some constraints at a time.
TEST(LocalSolvers, repeated_rows_multiply_as_if_they_were_read)
{
  Numbers value(2);
  for (const Blocks &blocks : all_blocks)
    for (const unsigned int n_nodes : {1u, 2u, 3u, 4u, 5u, 301u})
    {
      SCOPED_TRACE(blocks.name() + ", nodes: " + std::to_string(n_nodes));
      const unsigned int b = blocks.size, size = b * n_nodes;
      const Vector element = value(4 * b * b);
      const auto matrix = taut::make_block_tridiagonal(b, size);
      for (unsigned int node = 0; node + 1 < n_nodes; ++node)
        for (unsigned int i = 0; i < 2 * b; ++i)
          for (unsigned int j = 0; j <= i; ++j)
            if (blocks.couple(i, j))
              matrix->add(b * node + i, b * node + j, element[2 * b * i + j]);
      matrix->add(b * (n_nodes / 3), b * (n_nodes / 3), 3.);
      if (blocks.decoupled.empty())
        matrix->add(b * (2 * n_nodes / 3) + b - 1, b * (2 * n_nodes / 3), 2.);

      const Vector x = value(size);
      Vector expected(size, 0.);
      matrix->visit(
          [&](const unsigned int i, const unsigned int j, const double v)
          {
            expected[i] += v * x[j];
            if (i != j)
              expected[j] += v * x[i];
          });
      for (const bool repeated : {false, true})
      {
        if (repeated)
          matrix->find_repetitions();
        Vector product(size, 1.);
        matrix->vmult_add(2., x.data(), product.data());
        for (unsigned int i = 0; i < size; ++i)
          EXPECT_NEAR(product[i], 1. + 2. * expected[i], 1e-13) << i;
        matrix->vmult(x.data(), product.data());
        for (unsigned int i = 0; i < size; ++i)
          EXPECT_NEAR(product[i], expected[i], 1e-13) << i;
      }
      // Nothing at all is a repetition, too.
      const auto zero = taut::make_block_tridiagonal(b, size);
      zero->find_repetitions();
      Vector nothing(size, 1.);
      zero->vmult(x.data(), nothing.data());
      EXPECT_EQ(nothing, Vector(size, 0.));

      // What is added later counts.
      const unsigned int later = b * (n_nodes / 2);
      matrix->add(later, later, 1.);
      Vector product(size);
      matrix->vmult(x.data(), product.data());
      EXPECT_NEAR(product[later], expected[later] + x[later], 1e-13);
    }
}

// A spring of another kind of matrix stands between a node of a cable and the ground: upright, or
// at an angle, which couples the plane with z where the cable itself does not.
TEST(LocalSolvers, matrices_of_two_kinds_are_added)
{
  constexpr unsigned int b = 6, n_nodes = 40, size = b * n_nodes, node = 17;
  Numbers value(5);
  for (const bool cable_couples : {false, true})
    for (const bool spring_couples : {false, true})
    {
      SCOPED_TRACE(std::to_string(cable_couples) + ", " + std::to_string(spring_couples));
      const auto cable = value.matrix({b, cable_couples ? "" : "z"}, n_nodes);
      taut::CompressedMatrix spring(size);
      const double direction[3] = {.6, .8, spring_couples ? .5 : 0.};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          spring.add(b * node + i, b * node + j, 30. * direction[i] * direction[j]);
      const auto solver = taut::make_local_solver("block tridiagonal", *cable);
      solver->factor({{2., cable.get()}, {1., &spring}}, {});
      const Vector rhs = value(size);
      Vector product(size, 0.), x = rhs;
      solver->solve(x);
      cable->vmult_add(2., x.data(), product.data());
      spring.vmult_add(1., x.data(), product.data());
      EXPECT_LT(largest_difference(rhs, product), 1e-12);
    }
}

// Windows of any length at any place, padded or not.
TEST(LocalSolvers, scalar_products_of_windows_are_sums_of_their_terms)
{
  Numbers value(4);
  Vector x = value(60);
  for (unsigned int first : {0u, 1u, 20u, 50u})
    for (unsigned int length = 0; first + length <= x.size(); ++length)
    {
      taut::WindowedVector window;
      window.first = first;
      double sum = 0., size = 0.;
      for (unsigned int i = first; i < first + length; ++i)
      {
        window.value.push_back(value());
        sum += window.value.back() * x[i];
        size += std::fabs(window.value.back() * x[i]);
      }
      for (const bool padded : {false, true})
      {
        if (padded)
          window.pad(taut::ScalarProduct::lanes, x.size());
        ASSERT_LE(window.first + window.value.size(), x.size());
        taut::ScalarProduct product;
        product.add(window, x);
        product.add(window, x);
        EXPECT_NEAR(product.value(), 2. * sum, 1e-14) << first << ", " << length;
        EXPECT_NEAR(product.size(), 2. * size, 1e-13) << first << ", " << length;
      }
    }
}

TEST(LocalSolvers, refuse_what_is_not_held)
{
  for (const std::string &name : solver_names)
    for (const double k : {0., 1e-18})
    {
      const auto matrix = string(k);
      const auto solver = taut::make_local_solver(name, *matrix);
      EXPECT_THROW(solver->factor({{1., matrix.get()}}, {}), taut::BodyNotHeld)
          << name << ", " << k;
    }
}

// The node of a cable and its DoF, whether the plane and z are solved together or not.
TEST(LocalSolvers, name_what_is_not_held)
{
  constexpr unsigned int b = 6, n_nodes = 9;
  for (const bool coupled : {false, true})
    for (unsigned int loose = 0; loose < b; ++loose)
    {
      const auto matrix = taut::make_block_tridiagonal(b, b * n_nodes);
      for (unsigned int i = 0; i < b * n_nodes; ++i)
        if (i != 2 * b + loose)
          matrix->add(i, i, 1.);
      if (coupled)
        matrix->add(1, 2, .1);
      const auto solver = taut::make_local_solver("block tridiagonal", *matrix);
      const std::string message = verification::error_of(
          [&] {
            solver->factor({{1., matrix.get()}}, {});
          });
      EXPECT_TRUE(verification::has(message, "node 2, DoF " + std::to_string(loose)))
          << coupled << ", " << message;
    }
}
