// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mechanism/constrained_solver.h"

#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace taut
{
  namespace
  {
    /// Smallest independent part of a row of G, and smallest pivot over the largest pivot.
    constexpr double independent = 1e-10, smallest_pivot = 1e-15;
  } // namespace

  void ConstrainedSolver::factor(const std::vector<ScaledMatrix> &summands,
                                 const std::vector<unsigned int> &constrained)
  {
    const unsigned int size = summands.front().second->size();
    m = size - n;
    is_held.assign(size, 0);
    for (const unsigned int dof : constrained)
      is_held[dof] = 1;
    A.assign(n * n, 0.);
    G.assign(m * n, 0.);
    for (const auto &[factor, matrix] : summands)
      matrix->visit(
          [&, factor = factor](const unsigned int i, const unsigned int j, const double value)
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
    for (unsigned int i = 0; i < n; ++i)
      if (is_held[i])
        A[i * n + i] = 1.;
    find_bases();
    factor_reduced();
  }

  /// Householder's reflections of the rows of G, one after the other.
  void ConstrainedSolver::find_bases()
  {
    rows.clear();
    triangle.clear();
    Q.assign(n * n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      Q[i * n + i] = 1.;
    ReducedVector g(n), v(n);
    for (unsigned int row = 0; row < m; ++row)
    {
      const unsigned int r = rows.size();
      double size = 0., rest = 0.;
      for (unsigned int j = 0; j < n; ++j)
      {
        g[j] = 0.;
        for (unsigned int i = 0; i < n; ++i)
          g[j] += G[row * n + i] * Q[i * n + j];
        size += g[j] * g[j];
        rest += j < r ? 0. : g[j] * g[j];
      }
      if (r == n || !(rest > independent * independent * size))
        continue;
      std::fill(v.begin(), v.end(), 0.);
      std::copy(g.begin() + r, g.end(), v.begin() + r);
      const double pivot = std::copysign(std::sqrt(rest), -g[r]);
      v[r] -= pivot;
      double squared = 0.;
      for (const double x : v)
        squared += x * x;
      for (unsigned int i = 0; i < n; ++i)
      {
        double product = 0.;
        for (unsigned int j = r; j < n; ++j)
          product += Q[i * n + j] * v[j];
        for (unsigned int j = r; j < n; ++j)
          Q[i * n + j] -= 2. * product / squared * v[j];
      }
      g[r] = pivot;
      rows.push_back(row);
      triangle.emplace_back(g.begin(), g.begin() + r + 1);
    }
  }

  void ConstrainedSolver::factor_reduced()
  {
    const unsigned int r = rows.size(), f = n - r;
    AT.assign(n * f, 0.);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 0; k < n; ++k)
        if (A[i * n + k] != 0.)
          for (unsigned int j = 0; j < f; ++j)
            AT[i * f + j] += A[i * n + k] * Q[k * n + r + j];
    cholesky.assign(f * f, 0.);
    double largest = 0.;
    for (unsigned int i = 0; i < f; ++i)
    {
      for (unsigned int j = 0; j <= i; ++j)
        for (unsigned int k = 0; k < n; ++k)
          cholesky[i * f + j] += Q[k * n + r + i] * AT[k * f + j];
      largest = std::max(largest, cholesky[i * f + i]);
    }
    for (unsigned int j = 0; j < f; ++j)
    {
      double pivot = cholesky[j * f + j];
      for (unsigned int k = 0; k < j; ++k)
        pivot -= cholesky[j * f + k] * cholesky[j * f + k];
      if (!(pivot > smallest_pivot * largest))
        throw BodyNotHeld("nothing holds one of its motions, neither inertia nor stiffness");
      cholesky[j * f + j] = std::sqrt(pivot);
      for (unsigned int i = j + 1; i < f; ++i)
      {
        for (unsigned int k = 0; k < j; ++k)
          cholesky[i * f + j] -= cholesky[i * f + k] * cholesky[j * f + k];
        cholesky[i * f + j] /= cholesky[j * f + j];
      }
    }
  }

  void ConstrainedSolver::solve(std::vector<double> &x) const
  {
    const unsigned int r = rows.size(), f = n - r;
    ReducedVector b(x.begin(), x.begin() + n), q(n, 0.), w(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      if (is_held[i])
        b[i] = 0.;
    const auto add_product = [&](ReducedVector &y, const ReducedVector &z)
    {
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n; ++k)
          y[i] -= A[i * n + k] * z[k];
    };
    const auto component = [&](const ReducedVector &y, const unsigned int j)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < n; ++i)
        sum += Q[i * n + j] * y[i];
      return sum;
    };
    // The part of the solution that G prescribes.
    for (unsigned int k = 0; k < r; ++k)
    {
      double sum = is_held[n + rows[k]] ? 0. : x[n + rows[k]];
      for (unsigned int l = 0; l < k; ++l)
        sum -= triangle[k][l] * w[l];
      w[k] = sum / triangle[k][k];
      for (unsigned int i = 0; i < n; ++i)
        q[i] += w[k] * Q[i * n + k];
    }
    ReducedVector left = b;
    add_product(left, q);
    // The part of the solution that G allows.
    ReducedVector y(f);
    for (unsigned int i = 0; i < f; ++i)
    {
      y[i] = component(left, r + i);
      for (unsigned int k = 0; k < i; ++k)
        y[i] -= cholesky[i * f + k] * y[k];
      y[i] /= cholesky[i * f + i];
    }
    for (unsigned int i = f; i-- > 0;)
    {
      for (unsigned int k = i + 1; k < f; ++k)
        y[i] -= cholesky[k * f + i] * y[k];
      y[i] /= cholesky[i * f + i];
      for (unsigned int j = 0; j < n; ++j)
        q[j] += y[i] * Q[j * n + r + i];
    }
    left = b;
    add_product(left, q);
    std::fill(x.begin() + n, x.end(), 0.);
    for (unsigned int k = r; k-- > 0;)
    {
      double sum = component(left, k);
      for (unsigned int l = k + 1; l < r; ++l)
        sum -= triangle[l][k] * x[n + rows[l]];
      x[n + rows[k]] = sum / triangle[k][k];
    }
    for (unsigned int i = 0; i < n; ++i)
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
