// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the simplicial and the supernodal factor of a matrix give the same solutions and refuse
// the same matrices, and a narrow matrix is factored entry by entry. Expected: solutions equal to
// 1e-12 of the largest entry (the condition number is below 1e3), the right-hand side given back.
#include "common.h"

#include <taut/base/sparse_cholesky.h>

namespace
{
  using taut::CholeskyMethod;

  const CholeskyMethod both[] = {CholeskyMethod::simplicial, CholeskyMethod::supernodal};

  struct Matrix
  {
    std::size_t n = 0;
    taut::SymmetricEntries entries;
  };

  /// K + inertia * (mass at the nodes) of @p width by @p length bilinear elements in plane strain.
  Matrix elastic(const unsigned int width, const unsigned int length, const double inertia)
  {
    double element[8][8] = {};
    for (const double x : {.5 - std::sqrt(1. / 12.), .5 + std::sqrt(1. / 12.)})
      for (const double y : {.5 - std::sqrt(1. / 12.), .5 + std::sqrt(1. / 12.)})
      {
        const double gradient[4][2] = {{y - 1., x - 1.}, {1. - y, -x}, {-y, 1. - x}, {y, x}};
        for (unsigned int i = 0; i < 8; ++i)
          for (unsigned int j = 0; j < 8; ++j)
          {
            const double *u = gradient[i / 2], *v = gradient[j / 2];
            const unsigned int a = i % 2, b = j % 2;
            element[i][j] +=
                .25 * (u[a] * v[b] + u[b] * v[a] + (a == b ? u[0] * v[0] + u[1] * v[1] : 0.));
          }
      }
    Matrix matrix;
    matrix.n = std::size_t(2) * (width + 1) * (length + 1);
    for (unsigned int row = 0; row < length; ++row)
      for (unsigned int k = 0; k < width; ++k)
      {
        const unsigned int first = row * (width + 1) + k;
        const unsigned int node[4] = {first, first + 1, first + width + 1, first + width + 2};
        for (unsigned int i = 0; i < 8; ++i)
          for (unsigned int j = 0; j <= i; ++j)
            matrix.entries.add(2 * node[i / 2] + i % 2, 2 * node[j / 2] + j % 2,
                               element[i][j] + (i == j ? .25 * inertia : 0.));
      }
    return matrix;
  }

  std::vector<double> numbers(const std::size_t n)
  {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> value(-1., 1.);
    std::vector<double> x(n);
    std::generate(x.begin(), x.end(), [&] { return value(random); });
    return x;
  }
} // namespace

TEST(SparseCholesky, both_factors_give_the_same_solutions)
{
  taut::SparseCholesky factors[2] = {taut::SparseCholesky(both[0]), taut::SparseCholesky(both[1])};
  // The second matrix has the pattern of the first one.
  for (const double inertia : {.1, 3.})
  {
    const Matrix matrix = elastic(30, 30, inertia);
    const std::vector<double> b = numbers(matrix.n);
    std::vector<double> x[2] = {b, b};
    for (unsigned int k = 0; k < 2; ++k)
    {
      ASSERT_EQ(factors[k].factor(matrix.n, matrix.entries, 1e-15), matrix.n);
      EXPECT_EQ(factors[k].is_supernodal(), k == 1);
      factors[k].solve(x[k]);
      std::vector<double> product(matrix.n, 0.);
      matrix.entries.vmult_add(x[k], product);
      ASSERT_LE(verification::largest_difference(product, b), 1e-12);
    }
    ASSERT_LE(verification::largest_difference(x[0], x[1]), 1e-12 * verification::largest(x[0]));
    EXPECT_GE(factors[1].n_entries(), factors[0].n_entries());
    EXPECT_GT(factors[1].memory_consumption(), 8 * factors[1].n_entries());
  }
}

// Claim: products of half solutions are those with the inverse, with both factors, and a half is a
// small part of a whole solution. Expected: a^T x with A x = b solved whole.
TEST(SparseCholesky, halves_of_solutions_multiply_to_the_whole)
{
  for (const CholeskyMethod method : both)
    for (const double inertia : {.1, 3.})
    {
      const Matrix matrix = elastic(40, 40, inertia);
      taut::SparseCholesky factors(method);
      ASSERT_EQ(factors.factor(matrix.n, matrix.entries, 1e-15), matrix.n);
      const auto n = static_cast<unsigned int>(matrix.n);
      std::vector<taut::LinearForm> forms(6);
      forms[0].add(0, 1.);
      forms[1].add(n - 1, 2.);
      forms[2].add(0, 1.);
      forms[2].add(n - 1, -1.);
      forms[2].add(0, .5); // of one unknown twice
      forms[3].add(n / 2, 1.);
      forms[4].add(n / 3, -1.);
      forms[4].add(n / 2 + 1, 3.);
      std::vector<const taut::LinearForm *> all;
      for (const taut::LinearForm &form : forms)
        all.push_back(&form);
      taut::SparseHalves halves, one;
      factors.half_solutions(all, halves);
      EXPECT_TRUE(std::is_sorted(halves.index.begin(), halves.index.end()));
      factors.half_solutions({all.front()}, one);
      EXPECT_LT(one.index.size(), matrix.n / 4);
      const std::size_t lanes = taut::SparseHalves::lanes;
      for (std::size_t i = 0; i < forms.size(); ++i)
      {
        std::vector<double> x(matrix.n, 0.);
        forms[i].add_to(1., x);
        factors.solve(x);
        for (std::size_t j = 0; j < forms.size(); ++j)
        {
          double product = 0.;
          for (std::size_t e = 0; e < halves.value.size(); e += lanes)
            product += halves.value[e + i] * halves.value[e + j];
          EXPECT_NEAR(product, forms[j].dot(x), 1e-13);
        }
      }
    }
}

TEST(SparseCholesky, both_factors_refuse_what_is_not_definite)
{
  for (const CholeskyMethod method : both)
  {
    taut::SparseCholesky factors(method);
    // One eigenvalue or more below zero; the rigid body modes of a free body.
    for (const double inertia : {-.01, 0.})
    {
      const Matrix matrix = elastic(20, 20, inertia);
      EXPECT_LT(factors.factor(matrix.n, matrix.entries, 1e-12), matrix.n) << inertia;
    }
    // A row of its own tells which one it is, and that of two nearly equal ones which remain.
    Matrix matrix = elastic(20, 20, 1.);
    const std::size_t n = matrix.n;
    EXPECT_EQ(factors.factor(n, matrix.entries, 1e-12), n);
    matrix.entries.add(n, n, -1.);
    EXPECT_EQ(factors.factor(n + 1, matrix.entries, 1e-12), n);
    matrix.entries.value.back() = 1.;
    matrix.entries.add(n + 1, n, 1.);
    matrix.entries.add(n + 1, n + 1, 1. + 1e-14);
    EXPECT_EQ(factors.factor(n + 2, matrix.entries, 1e-15), n + 2);
    const std::size_t bad = factors.factor(n + 2, matrix.entries, 1e-12);
    EXPECT_TRUE(bad == n || bad == n + 1) << bad;
    // And the factor may be used for another matrix.
    matrix.entries.value.back() = 3.;
    EXPECT_EQ(factors.factor(n + 2, matrix.entries, 1e-12), n + 2);
    matrix.entries.value.back() = std::nan("");
    EXPECT_LT(factors.factor(n + 2, matrix.entries, 1e-12), n + 2);
  }
}

// The pivots of both are the same numbers: they pass or fail with the same bound.
TEST(SparseCholesky, both_factors_have_the_same_pivots)
{
  const Matrix matrix = elastic(12, 12, 1.);
  taut::SparseCholesky simplicial(both[0]), supernodal(both[1]);
  unsigned int n_accepted = 0;
  for (double bound = .2; bound < 1.; bound += .0101)
  {
    const std::size_t first = simplicial.factor(matrix.n, matrix.entries, bound),
                      second = supernodal.factor(matrix.n, matrix.entries, bound);
    EXPECT_EQ(first == matrix.n, second == matrix.n) << bound;
    n_accepted += first == matrix.n;
  }
  EXPECT_GT(n_accepted, 5u);
  EXPECT_LT(n_accepted, 70u);
}

TEST(SparseCholesky, chooses_by_operations_per_entry)
{
  // A strip, and a full matrix of n rows with 2/3 n operations an entry.
  Matrix strip = elastic(4, 500, 1.);
  Matrix full;
  full.n = 2 * static_cast<std::size_t>(taut::SparseCholesky::least_supernodal_flops);
  for (std::size_t i = 0; i < full.n; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      full.entries.add(i, j, i == j ? 2. * full.n : 1.);
  for (Matrix *matrix : {&strip, &full})
  {
    taut::SparseCholesky chosen(CholeskyMethod::automatic),
        other(matrix == &full ? CholeskyMethod::supernodal : CholeskyMethod::simplicial);
    ASSERT_EQ(chosen.factor(matrix->n, matrix->entries, 1e-15), matrix->n);
    ASSERT_EQ(other.factor(matrix->n, matrix->entries, 1e-15), matrix->n);
    EXPECT_EQ(chosen.is_supernodal(), matrix == &full);
    EXPECT_EQ(chosen.flops_per_entry() >= taut::SparseCholesky::least_supernodal_flops,
              matrix == &full);
    std::vector<double> x = numbers(matrix->n), y = x;
    chosen.solve(x);
    other.solve(y);
    EXPECT_EQ(x, y); // bit by bit
  }
}
