// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a matrix that is singular up to rounding is an error that names a DoF, never an answer.
// Source: a string of equal springs; held at an end by k its last pivot is that of n + 1/k, free at
// both ends it is zero.
#include <taut/base/exceptions.h>
#include <taut/substructure/local_solver.h>

#include <gtest/gtest.h>

#include <cmath>

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
