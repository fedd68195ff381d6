// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the sparse operator with its dense border gives the products, solutions and verdicts on
// dependent rows of the dense operator, which a Cholesky factor of its own computes. Expected:
// equal to 1e-12 of the largest entry (condition numbers are below 1e3).
#include "common.h"

#include "complementarity/dense_operator.h"
#include "complementarity/sparse_operator.h"

namespace
{
  constexpr std::size_t n = 60, n_border = 3, bandwidth = 4;

  /// The same definite matrix in both forms: banded, with full rows at the end.
  struct Pair
  {
    taut::DenseOperator dense;
    taut::SparseOperator sparse;
    std::mt19937 generator{7};

    double number() { return std::uniform_real_distribution<double>(-1., 1.)(generator); }

    Pair() : dense(n)
    {
      sparse.reinit(n, n_border);
      taut::SymmetricEntries entries;
      for (std::size_t i = 0; i < n - n_border; ++i)
        for (std::size_t j = i < bandwidth ? 0 : i - bandwidth; j <= i; ++j)
        {
          const double value = i == j ? 10. : number();
          dense.set(i, j, value);
          // In two shares, as from two bodies.
          entries.add(i, j, .25 * value);
          entries.add(j, i, .75 * value);
        }
      sparse.set_interior(entries);
      set_border();
    }

    void set_border()
    {
      for (std::size_t i = n - n_border; i < n; ++i)
      {
        std::vector<double> row(n);
        for (std::size_t j = 0; j < n; ++j)
          row[j] = i == j ? 12. : j < i ? number() : dense(i, j);
        for (std::size_t j = 0; j < n; ++j)
          dense.set(i, j, row[j]);
        sparse.set_border(i, row);
      }
    }

    std::vector<double> vector()
    {
      std::vector<double> x(n);
      std::generate(x.begin(), x.end(), [this] { return number(); });
      return x;
    }
  };

  void expect_close(const std::vector<double> &a, const std::vector<double> &b)
  {
    EXPECT_LE(verification::largest_difference(a, b), 1e-12);
  }

  void expect_same_products(Pair &F)
  {
    const std::vector<double> x = F.vector();
    std::vector<double> y, z;
    F.dense.apply(x, y);
    F.sparse.apply(x, z);
    expect_close(y, z);
    F.dense.apply_absolute(x, y);
    F.sparse.apply_absolute(x, z);
    expect_close(y, z);
  }

  void expect_same_solutions(Pair &F, const std::vector<std::size_t> &set)
  {
    std::vector<double> x, y;
    for (const double shift : {0., 1e-2})
    {
      const std::vector<double> rhs = F.vector();
      ASSERT_TRUE(F.dense.solve(set, rhs, shift, x));
      ASSERT_TRUE(F.sparse.solve(set, rhs, shift, y));
      expect_close(x, y);
    }
  }
} // namespace

TEST(SparseOperator, multiplies_like_the_dense_one)
{
  Pair F;
  expect_same_products(F);
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_DOUBLE_EQ(F.dense.diagonal(i), F.sparse.diagonal(i));
}

TEST(SparseOperator, solves_like_the_dense_one_as_sets_and_border_change)
{
  Pair F;
  std::vector<std::size_t> set;
  for (int turn = 0; turn < 20; ++turn)
  {
    // The same set twice, then another; the border anew each time.
    if (turn % 2 == 0)
    {
      set.clear();
      for (std::size_t i = 0; i < n; ++i)
        if (F.number() > -.5)
          set.push_back(i);
    }
    expect_same_solutions(F, set);
    F.set_border();
  }
}

TEST(SparseOperator, takes_other_diagonals_inside_and_in_the_border)
{
  Pair F;
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> y;
  for (const std::size_t i : {std::size_t(3), n - n_border, n - 1})
  {
    // Once with a factor that is there already.
    const std::vector<double> rhs = F.vector();
    ASSERT_TRUE(F.sparse.solve(all, rhs, 0., y));
    F.dense.set(i, i, 20. + i);
    F.sparse.set_diagonal(i, 20. + i);
    EXPECT_EQ(F.sparse.diagonal(i), 20. + i);
    expect_same_products(F);
    expect_same_solutions(F, all);
  }
}

TEST(SparseOperator, tells_dependent_rows_inside_and_in_the_border)
{
  // Row 1 is row 0 again; the last row of the border is twice the row before.
  taut::SparseOperator F;
  F.reinit(4, 2);
  taut::SymmetricEntries entries;
  entries.add(0, 0, 2.);
  entries.add(1, 0, 2.);
  entries.add(1, 1, 2.);
  F.set_interior(entries);
  F.set_border(2, {1., 1., 3., 6.});
  F.set_border(3, {2., 2., 6., 12.});
  const std::vector<double> rhs = {1., 1., 1., 2.};
  std::vector<double> x;
  EXPECT_FALSE(F.solve({0, 1}, rhs, 0., x));
  EXPECT_FALSE(F.solve({0, 2, 3}, rhs, 0., x));
  EXPECT_TRUE(F.solve({0, 2}, rhs, 0., x));
  // 2 x0 + x2 = 1, x0 + 3 x2 = 1
  EXPECT_NEAR(x[0], .4, 1e-15);
  EXPECT_NEAR(x[2], .2, 1e-15);
  EXPECT_TRUE(F.solve({0, 1, 2, 3}, rhs, 1e-3, x));
}

TEST(SparseOperator, keeps_what_is_left_under_closed_rows_like_the_dense_one)
{
  Pair F;
  std::vector<double> x, y, z;
  const std::vector<std::size_t> wanted = {0, 7, 30, n - 2, n - 1};
  for (const std::vector<std::size_t> &set :
       {std::vector<std::size_t>{}, {1, 2, 8, 31, 40}, {3, 6, n - 3, n - 2}, {n - 1}})
  {
    F.sparse.condensed_diagonal(wanted, set, 1e-9, nullptr, x);
    F.dense.condensed_diagonal(wanted, set, 1e-9, nullptr, y);
    F.dense.ComplementarityOperator::condensed_diagonal(wanted, set, 1e-9, nullptr, z);
    EXPECT_EQ(y, z);
    expect_close(y, x);
  }
}

TEST(SparseOperator, takes_entries_in_other_places)
{
  // Fewer bands, the same again with other values, then more than ever before.
  Pair F;
  std::vector<std::size_t> set;
  for (std::size_t i = 0; i < n; i += 1 + i % 3)
    set.push_back(i);
  for (const std::size_t width : {2, 2, 1, 6, 3})
  {
    taut::SymmetricEntries entries;
    for (std::size_t i = 0; i < n - n_border; ++i)
      for (std::size_t j = 0; j <= i; ++j)
      {
        const double value = i == j ? 15. : j + width < i ? 0. : F.number();
        F.dense.set(i, j, value);
        if (value != 0.)
          entries.add(i, j, value);
      }
    F.sparse.set_interior(entries);
    expect_same_products(F);
    expect_same_solutions(F, set);
  }
}

// Rows that no multiplier moves, or that no shift makes definite, do not condense the others.
TEST(SparseOperator, rows_without_an_answer_leave_the_diagonal)
{
  // Row 1 has no entry; rows 2 and 3 have a negative determinant.
  const double F[4][4] = {{2., 0., .3, .1}, {0., 0., 0., 0.}, {.3, 0., 1., 2.}, {.1, 0., 2., 1.}};
  taut::DenseOperator dense(4);
  taut::SparseOperator sparse;
  sparse.reinit(4, 0);
  taut::SymmetricEntries entries;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j <= i; ++j)
    {
      dense.set(i, j, F[i][j]);
      entries.add(i, j, F[i][j]);
    }
  sparse.set_interior(entries);
  for (const std::vector<std::size_t> &set : {std::vector<std::size_t>{1}, {2, 3}, {1, 2, 3}})
  {
    std::vector<double> x, y, z;
    sparse.condensed_diagonal({0}, set, 1e-9, nullptr, x);
    dense.condensed_diagonal({0}, set, 1e-9, nullptr, y);
    dense.ComplementarityOperator::condensed_diagonal({0}, set, 1e-9, nullptr, z);
    for (const std::vector<double> &result : {x, y, z})
      EXPECT_EQ(result, (std::vector<double>{2., 0., 0., 0.})) << set.size();
  }
}
