// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matrix_free_schur_complement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut
{
  namespace
  {
    /// Relative residual at which conjugate gradients stop, and the one that still counts as
    /// solved.
    constexpr double wanted_residual = 1e-15, accepted_residual = 1e-11;

    /// How often conjugate gradients start anew from the true residual.
    constexpr int most_restarts = 4;

    /// The larger one; not-a-number if one is.
    double larger(const double a, const double b)
    {
      return a > b || std::isnan(a) ? a : b;
    }

    double dot(const std::vector<double> &x, const std::vector<double> &y)
    {
      return std::inner_product(x.begin(), x.end(), y.begin(), 0.);
    }

    /**
     * Conjugate gradients preconditioned by the diagonal, from x and its residual r = b - F x; ends
     * when r^T diagonal^-1 r has fallen by the square of the wanted residual, after @p bound steps,
     * or at a direction along which F is not positive.
     */
    void conjugate_gradients(const ContactSchurOperator &F, const std::vector<double> &diagonal,
                             const int bound, std::vector<double> &x, std::vector<double> &r)
    {
      const std::size_t n = x.size();
      std::vector<double> z(n), p(n, 0.), q(n);
      double rz = 1., goal = 0.;
      for (int iteration = 0; iteration <= bound; ++iteration)
      {
        for (std::size_t i = 0; i < n; ++i)
          z[i] = r[i] / diagonal[i];
        const double next = dot(r, z), beta = iteration == 0 ? 0. : next / rz;
        rz = next;
        if (iteration == 0)
          goal = wanted_residual * wanted_residual * rz;
        if (!(rz > goal))
          return;
        for (std::size_t i = 0; i < n; ++i)
          p[i] = z[i] + beta * p[i];
        F.apply(p.data(), q.data());
        const double curvature = dot(p, q);
        if (!(curvature > 0.))
          return;
        const double alpha = rz / curvature;
        for (std::size_t i = 0; i < n; ++i)
        {
          x[i] += alpha * p[i];
          r[i] -= alpha * q[i];
        }
      }
    }
  } // namespace

  MatrixFreeSchurComplement::MatrixFreeSchurComplement(const FactoredStructure &solvers,
                                                       const ContactRows &rows)
      : solvers(solvers), rows(rows), F(solvers, rows), diagonal_entries(rows.size(), 0.),
        work(solvers.structure().zero())
  {
  }

  void MatrixFreeSchurComplement::compute_diagonal(const std::size_t i)
  {
    std::vector<double> unit(rows.size(), 0.), column(rows.size());
    unit[i] = 1.;
    F.apply(unit.data(), column.data());
    diagonal_entries[i] = column[i];
  }

  void MatrixFreeSchurComplement::setup(const std::vector<double> &S)
  {
    compliance = S;
    F.set_compliance(S);
    for (std::size_t i = 0; i < rows.size(); ++i)
      compute_diagonal(i);
  }

  void MatrixFreeSchurComplement::update_moving()
  {
    for (std::size_t i = rows.n_fixed(); i < rows.size(); ++i)
      compute_diagonal(i);
  }

  void MatrixFreeSchurComplement::free_motion(const BlockVector &P, std::vector<double> &d,
                                              std::vector<double> &terms_size) const
  {
    work = P;
    solvers.solve(work);
    d.resize(rows.size());
    terms_size.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      d[i] = evaluate(rows[i].terms, work);
      terms_size[i] = magnitude(rows[i].terms, work);
    }
  }

  std::string MatrixFreeSchurComplement::description() const
  {
    return "matrix-free, " + std::to_string(rows.size()) + " rows";
  }

  void MatrixFreeSchurComplement::apply(const std::vector<double> &x, std::vector<double> &y) const
  {
    y.resize(x.size());
    F.apply(x.data(), y.data());
  }

  void MatrixFreeSchurComplement::apply_absolute(const std::vector<double> &x,
                                                 std::vector<double> &y) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += std::sqrt(diagonal_entries[i]) * std::fabs(x[i]);
    y.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      y[i] = std::sqrt(diagonal_entries[i]) * sum;
  }

  bool MatrixFreeSchurComplement::solve(const std::vector<std::size_t> &set,
                                        const std::vector<double> &rhs, const double shift,
                                        std::vector<double> &x)
  {
    x.assign(rows.size(), 0.);
    std::vector<double> b(rows.size(), 0.), scale(rows.size(), 1.);
    for (const std::size_t i : set)
    {
      b[i] = rhs[i];
      if (diagonal_entries[i] > 0.)
        scale[i] = (1. + shift) * diagonal_entries[i];
    }
    if (std::all_of(b.begin(), b.end(), [](const double v) { return v == 0.; }))
      return true;

    F.restrict_to(set);
    F.set_shift(shift, diagonal_entries);
    const int bound = 100 + 10 * static_cast<int>(set.size());

    // What counts is the true residual, not the one of the recursion; rows are compared by their
    // own scale.
    std::vector<double> r = b, Fx(rows.size());
    double error = 0., size = 0., best = std::numeric_limits<double>::infinity();
    std::vector<double> best_x = x;
    for (int restart = 0; restart < most_restarts; ++restart)
    {
      conjugate_gradients(F, scale, bound, x, r);
      F.apply(x.data(), Fx.data());
      error = size = 0.;
      for (const std::size_t i : set)
      {
        r[i] = b[i] - Fx[i];
        const double root = std::sqrt(scale[i]);
        error = larger(error, std::fabs(r[i]) / root);
        size = larger(size, larger(std::fabs(b[i]) / root, root * std::fabs(x[i])));
      }
      if (!(error < .5 * best))
        break;
      best = error;
      best_x = x;
      if (error <= wanted_residual * size)
        break;
    }
    x = best_x;
    F.unrestrict();
    F.set_shift(0., diagonal_entries);
    return std::isfinite(best) && best <= accepted_residual * size;
  }
} // namespace taut
