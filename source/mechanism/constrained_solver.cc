// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mechanism/constrained_solver.h"

#include <taut/base/exceptions.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

extern "C" void dgeqp3_(const int *m, const int *n, double *A, const int *lda, int *pivots,
                        double *tau, double *work, const int *lwork, int *info);

namespace taut
{
  namespace
  {
    /// Smallest independent part of a row of G, and smallest pivot over the largest pivot.
    constexpr double independent = 1e-10, smallest_pivot = 1e-15;

    /// y = factor op(A) x + own y with the n x n_columns matrix A.
    void multiply(const char op, const int n, const int n_columns, const double factor,
                  const double *A, const double *x, const double own, double *y)
    {
      constexpr int one = 1;
      dealii::gemv(&op, &n, &n_columns, &factor, A, &n, x, &one, &own, y, &one);
    }
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
      double squares = 0.;
      for (int i = 0; i < n; ++i)
        squares += G[row * n + i] * G[row * n + i];
      scale[row] = squares > 0. ? 1. / std::sqrt(squares) : 0.;
      for (int i = 0; i < n; ++i)
        G[row * n + i] *= scale[row];
    }
    const int n_reflections = std::min(n, m), n_work = 64 * (n + m + 1);
    tau.resize(n_reflections);
    work.resize(n_work);
    int info;
    rows.assign(m, 0);
    Q.assign(n * n, 0.);
    r = 0;
    if (m > 0)
      dgeqp3_(&n, &m, G.data(), &n, rows.data(), tau.data(), work.data(), &n_work, &info);
    while (r < n_reflections && std::fabs(G[r * n + r]) > independent)
      ++r;
    std::copy_n(G.begin(), n_reflections * n, Q.begin());
    dealii::orgqr(&n, &n, &n_reflections, Q.data(), &n, tau.data(), work.data(), &n_work, &info);
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
    constexpr double one = 1., zero = 0.;
    dealii::gemm("N", "N", &n, &f, &n, &one, A.data(), &n, allowed, &n, &zero, AT.data(), &n);
    dealii::gemm("T", "N", &f, &f, &n, &one, allowed, &n, AT.data(), &n, &zero, cholesky.data(),
                 &f);
    double largest = 0.;
    for (int i = 0; i < f; ++i)
      largest = std::max(largest, cholesky[i * f + i]);
    int info;
    dealii::potrf("L", &f, cholesky.data(), &f, &info);
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
    const auto solve_triangle = [this](const char *op, double *z)
    {
      constexpr int one = 1;
      int info;
      if (r > 0)
        dealii::trtrs("U", op, "N", &r, &one, G.data(), &n, z, &n, &info);
    };
    // The part of the solution that G prescribes.
    for (int k = 0; k < r; ++k)
      y[k] = scale[rows[k] - 1] * x[n + rows[k] - 1];
    solve_triangle("T", y.data());
    multiply('N', n, r, 1., Q.data(), y.data(), 0., q.data());
    // The part of the solution that G allows.
    ReducedVector left = b;
    multiply('N', n, n, -1., A.data(), q.data(), 1., left.data());
    if (f > 0)
    {
      constexpr int n_rhs = 1;
      int info;
      multiply('T', n, f, 1., &Q[r * n], left.data(), 0., y.data());
      dealii::potrs("L", &f, &n_rhs, cholesky.data(), &f, y.data(), &f, &info);
      multiply('N', n, f, 1., &Q[r * n], y.data(), 1., q.data());
    }
    left = b;
    multiply('N', n, n, -1., A.data(), q.data(), 1., left.data());
    multiply('T', n, r, 1., Q.data(), left.data(), 0., y.data());
    solve_triangle("N", y.data());
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
