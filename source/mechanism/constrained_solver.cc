// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mechanism/constrained_solver.h"

#include <taut/base/exceptions.h>

#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Smallest independent part of a row of G, and smallest pivot over the largest pivot.
    constexpr double independent = 1e-10, smallest_pivot = 1e-15;

    const Teuchos::BLAS<int, double> blas;
    const Teuchos::LAPACK<int, double> lapack;
  } // namespace

  void ConstrainedSolver::factor(const std::vector<ScaledMatrix> &summands,
                                 const std::vector<unsigned int> &constrained)
  {
    const int size = summands.front().second->size();
    m = size - n;
    is_held.assign(size, 0);
    for (const unsigned int dof : constrained)
      is_held[dof] = 1;
    A.assign(n * n, 0.);
    G.assign(m * n, 0.);
    for (const auto &[factor, matrix] : summands)
      matrix->visit(
          [&, factor = factor](const int i, const int j, const double value)
          {
            if (is_held[i] || is_held[j])
              return;
            if (i >= n)
              G[(i - n) * n + j] += factor * value;
            else
            {
              A[i * n + j] += factor * value;
              if (i != j)
                A[j * n + i] += factor * value;
            }
          });
    for (int i = 0; i < n; ++i)
      if (is_held[i])
        A[i * n + i] = 1.;
    find_bases();
    factor_reduced();
  }

  /// Q R of the rows of G, each scaled to 1, with the most independent ones first.
  void ConstrainedSolver::find_bases()
  {
    scale.assign(m, 0.);
    for (int row = 0; row < m; ++row)
    {
      const double size = blas.NRM2(n, &G[row * n], 1);
      scale[row] = size > 0. ? 1. / size : 0.;
      blas.SCAL(n, scale[row], &G[row * n], 1);
    }
    const int n_reflections = std::min(n, m), n_work = 64 * (n + m + 1);
    tau.resize(n_reflections);
    work.resize(n_work);
    int info;
    rows.assign(m, 0);
    Q.assign(n * n, 0.);
    r = 0;
    if (m > 0)
      lapack.GEQP3(n, m, G.data(), n, rows.data(), tau.data(), work.data(), n_work, nullptr, &info);
    while (r < n_reflections && std::fabs(G[r * n + r]) > independent)
      ++r;
    std::copy_n(G.begin(), n_reflections * n, Q.begin());
    lapack.ORGQR(n, n, n_reflections, Q.data(), n, tau.data(), work.data(), n_work, &info);
  }

  /// A on the motions that G allows, the last columns of Q.
  void ConstrainedSolver::factor_reduced()
  {
    const int f = n - r;
    AT.resize(n * f);
    cholesky.resize(f * f);
    if (f == 0)
      return;
    const double *const allowed = &Q[r * n];
    blas.SYMM(Teuchos::LEFT_SIDE, Teuchos::LOWER_TRI, n, f, 1., A.data(), n, allowed, n, 0.,
              AT.data(), n);
    blas.GEMM(Teuchos::TRANS, Teuchos::NO_TRANS, f, f, n, 1., allowed, n, AT.data(), n, 0.,
              cholesky.data(), f);
    double largest = 0.;
    for (int i = 0; i < f; ++i)
      largest = std::max(largest, cholesky[i * f + i]);
    int info;
    lapack.POTRF('L', f, cholesky.data(), f, &info);
    bool is_held = info == 0;
    for (int i = 0; i < f; ++i)
      is_held = is_held && cholesky[i * f + i] * cholesky[i * f + i] > smallest_pivot * largest;
    if (!is_held)
      throw BodyNotHeld("nothing holds one of its motions, neither inertia nor stiffness");
  }

  void ConstrainedSolver::solve(std::vector<double> &x) const
  {
    const int f = n - r;
    ReducedVector b(x.begin(), x.begin() + n), q(n), y(n);
    for (int i = 0; i < n; ++i)
      if (is_held[i])
        b[i] = 0.;
    const auto multiply_add = [this](const Teuchos::ETransp trans, const int n_columns,
                                     const double factor, const double *matrix, const double *z,
                                     const double own, double *result)
    { blas.GEMV(trans, n, n_columns, factor, matrix, n, z, 1, own, result, 1); };
    const auto solve_triangle = [this](const Teuchos::ETransp trans, double *z)
    {
      blas.TRSM(Teuchos::LEFT_SIDE, Teuchos::UPPER_TRI, trans, Teuchos::NON_UNIT_DIAG, r, 1, 1.,
                G.data(), n, z, n);
    };
    // The part of the solution that G prescribes.
    for (int k = 0; k < r; ++k)
      y[k] = scale[rows[k] - 1] * x[n + rows[k] - 1];
    solve_triangle(Teuchos::TRANS, y.data());
    multiply_add(Teuchos::NO_TRANS, r, 1., Q.data(), y.data(), 0., q.data());
    // The part of the solution that G allows.
    ReducedVector left = b;
    multiply_add(Teuchos::NO_TRANS, n, -1., A.data(), q.data(), 1., left.data());
    if (f > 0)
    {
      int info;
      multiply_add(Teuchos::TRANS, f, 1., &Q[r * n], left.data(), 0., y.data());
      lapack.POTRS('L', f, 1, cholesky.data(), f, y.data(), f, &info);
      multiply_add(Teuchos::NO_TRANS, f, 1., &Q[r * n], y.data(), 1., q.data());
    }
    left = b;
    multiply_add(Teuchos::NO_TRANS, n, -1., A.data(), q.data(), 1., left.data());
    multiply_add(Teuchos::TRANS, r, 1., Q.data(), left.data(), 0., y.data());
    solve_triangle(Teuchos::NO_TRANS, y.data());
    std::fill(x.begin(), x.end(), 0.);
    for (int k = 0; k < r; ++k)
      x[n + rows[k] - 1] = scale[rows[k] - 1] * y[k];
    for (int i = 0; i < n; ++i)
      x[i] = is_held[i] ? 0. : q[i];
  }

  void ConstrainedSolver::column(const LinearForm &rhs, WindowedVector &x) const
  {
    x.first = 0;
    x.value.assign(n + m, 0.);
    rhs.add_to(1., x.value);
    solve(x.value);
  }

  double ConstrainedSolver::flexibility(const LinearForm &rhs) const
  {
    WindowedVector x;
    column(rhs, x);
    return x.dot(rhs);
  }
} // namespace taut
