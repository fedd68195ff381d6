// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: local solvers solve, whole vectors and columns, for every size of block and with
// constrained unknowns; a matrix that is singular up to rounding is an error, never an answer.
// Sources: the product with the matrix has to give back the right-hand side; a string of equal
// springs is singular if nothing holds its end.
#include <taut/base/exceptions.h>
#include <taut/substructure/local_solver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{
  constexpr unsigned int n = 41;

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
  for (const std::string name : {"block tridiagonal", "sparse direct"})
  {
    const auto matrix = string(.5);
    const auto solver = taut::make_local_solver(name, *matrix);
    solver->factor({{1., matrix.get()}}, {});
    // 1 N at the far end stretches every spring by 1 m, and the first one by 2 m.
    std::vector<double> x(n, 0.);
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
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-1., 1.);
  constexpr unsigned int n_nodes = 201;
  for (unsigned int b = 1; b <= 4; ++b)
    for (const std::string name : {"block tridiagonal", "sparse direct"})
    {
      SCOPED_TRACE(name + ", blocks of " + std::to_string(b));
      const unsigned int size = b * n_nodes;
      const auto matrix = taut::make_block_tridiagonal(b, size);
      for (unsigned int i = 0; i < size; ++i)
        for (unsigned int j = i / b == 0 ? 0 : b * (i / b - 1); j <= i; ++j)
          matrix->add(i, j, i == j ? 4. * b : value(random));
      const std::vector<unsigned int> held = {0, size / 2, size - 1};
      const auto solver = taut::make_local_solver(name, *matrix);
      solver->factor({{.5, matrix.get()}, {1.5, matrix.get()}}, held);
      const auto check = [&](std::vector<double> x, const std::vector<double> &rhs)
      {
        for (const unsigned int dof : held)
          EXPECT_EQ(x[dof], 0.);
        std::vector<double> product(size, 0.);
        matrix->vmult_add(2., x.data(), product.data());
        for (unsigned int i = 0; i < size; ++i)
          if (i != held[0] && i != held[1] && i != held[2])
          {
            EXPECT_NEAR(product[i], rhs[i], 1e-12) << i;
          }
      };
      std::vector<double> rhs(size);
      for (double &v : rhs)
        v = value(random);
      std::vector<double> x = rhs;
      solver->solve(x);
      check(x, rhs);

      for (unsigned int node = 0; node + 1 < n_nodes; ++node)
      {
        taut::SparseVector form;
        std::vector<double> load(size, 0.);
        for (unsigned int i = b * node; i < b * (node + 2); ++i)
          form.add(i, load[i] = value(random));
        taut::WindowedVector column;
        solver->column(form, column);
        if (name == "block tridiagonal")
        {
          EXPECT_LT(column.value.size(), size);
        }
        std::vector<double> full(size, 0.);
        std::copy(column.value.begin(), column.value.end(), full.begin() + column.first);
        check(full, load);
      }
    }
}

TEST(LocalSolvers, refuse_what_is_not_held)
{
  for (const std::string name : {"block tridiagonal", "sparse direct"})
    for (const double k : {0., 1e-18})
    {
      const auto matrix = string(k);
      const auto solver = taut::make_local_solver(name, *matrix);
      EXPECT_THROW(solver->factor({{1., matrix.get()}}, {}), taut::BodyNotHeld)
          << name << ", " << k;
    }
}
