// SPDX-License-Identifier: LGPL-2.1-or-later
#include "complementarity/mprgp.h"

#include "base/dot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// Length of a projected gradient step over 1 / |F|: from 2 on it may raise the energy. Longer
    /// steps close more rows at once; the bound of the rate is the best with 1.
    constexpr double step_length = 1.9;

    /// Free gradient over the chopped one from which conjugate gradients go on: with 1 the bound of
    /// the rate is the best.
    constexpr double proportion = 1.;

    /// Gradient over that of zero multipliers at which the rows that are closed are known. They are
    /// then solved exactly, by ActiveSetSystem.
    constexpr double known = 1e-9;

    /// Products with F of a power iteration, whose norm is a lower bound by a few per cent, and
    /// what is added to it. A step that still raises the energy doubles it.
    constexpr int products_for_norm = 20;
    constexpr double above_norm = 1.1;

    /// Most products with F, and most updates of the Lagrange multipliers of the balance: with a
    /// penalty of |F| each halves their error at least, and thirty give nine digits.
    constexpr unsigned int most_products = 5000, most_balance_updates = 60;

    /// Diagonal entry over the mean below which it is rounding of a pseudo-inverse, as in
    /// NullSpacePenalty.
    constexpr double least_diagonal = 1e-6;

    /// Curvature of F along a direction, over |F|, below which it is rounding.
    constexpr double no_curvature = 1e-13;

    double length(const std::vector<double> &x)
    {
      return std::sqrt(taut::dot(x, x));
    }

    void add_multiple(std::vector<double> &y, const double factor, const std::vector<double> &x)
    {
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] += factor * x[i];
    }
  } // namespace

  /// F and the resisted amplitudes, alpha = E^-1 (G N + e), and the penalty of the others.
  void Mprgp::multiply(const std::vector<double> &y, std::vector<double> &Hy)
  {
    ++products;
    for (std::size_t i = 0; i < y.size(); ++i)
      multiplier[i] = scale[i] * y[i];
    matrix->apply(multiplier, Hy);
    for (std::size_t k = 0; k < problem->n_null_space(); ++k)
      if (problem->resistance(k) > 0.)
        problem->null_space[k].add_to(
            problem->null_space[k].dot(multiplier) / problem->resistance(k), Hy);
    if (penalty && factor > 0.)
    {
      std::vector<double> forces(held.n_null_space());
      for (std::size_t k = 0; k < forces.size(); ++k)
        forces[k] = held.null_space[k].dot(multiplier);
      const std::vector<double> amplitude = penalty->weigh(forces);
      for (std::size_t k = 0; k < forces.size(); ++k)
        held.null_space[k].add_to(factor * amplitude[k], Hy);
    }
    for (std::size_t i = 0; i < y.size(); ++i)
      Hy[i] *= scale[i];
  }

  void Mprgp::find_norm()
  {
    std::vector<double> y(problem->size()), Hy;
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = scale[i] > 0. ? 1. + .5 * std::cos(7. * i) : 0.;
    norm = 0.;
    for (int k = 0; k < products_for_norm; ++k)
    {
      const double size = length(y);
      if (!(size > 0.))
        break;
      for (double &value : y)
        value /= size;
      multiply(y, Hy);
      norm = std::max(norm, length(Hy));
      y = Hy;
    }
    norm *= above_norm;
  }

  /// Free, reduced free and chopped gradient.
  void Mprgp::split(const std::vector<double> &y)
  {
    for (std::size_t i = 0; i < y.size(); ++i)
    {
      const bool may_fall = problem->cones[i].is_free() || y[i] > 0.;
      free_gradient[i] = may_fall ? g[i] : 0.;
      chopped[i] = may_fall ? 0. : std::min(g[i], 0.);
      reduced[i] = may_fall && !problem->cones[i].is_free()
                       ? std::min(y[i] * norm / step_length, g[i])
                       : free_gradient[i];
    }
  }

  /// Lowers 1/2 y^T H y + d^T y until its projected gradient is at most @p wanted. False if
  /// there is no minimum, or too many products do not find it.
  bool Mprgp::descend(const std::vector<double> &d, const double wanted, std::vector<double> &y)
  {
    std::vector<double> p, Hp, before;
    const auto set_gradient = [&]
    {
      multiply(y, g);
      add_multiple(g, 1., d);
      split(y);
      p = free_gradient;
    };
    const auto energy = [&] { return .5 * (dot(y, g) + dot(y, d)); };
    set_gradient();
    while (products < most_products)
    {
      const double of_free = dot(free_gradient, free_gradient), of_chopped = dot(chopped, chopped);
      if (std::sqrt(of_free + of_chopped) <= wanted)
        break;
      const bool opens = of_chopped > proportion * proportion * dot(reduced, free_gradient);
      if (opens)
        p = chopped;
      multiply(p, Hp);
      const double pHp = dot(p, Hp);
      double longest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < y.size(); ++i)
        if (!problem->cones[i].is_free() && p[i] > 0.)
          longest = std::min(longest, y[i] / p[i]);
      const bool is_flat = pHp <= no_curvature * norm * dot(p, p);
      if (is_flat && std::isinf(longest))
        return false;
      const double step = is_flat ? longest : dot(g, p) / pHp;
      if (step <= longest)
      {
        add_multiple(y, -step, p);
        add_multiple(g, -step, Hp);
        for (std::size_t i = 0; i < y.size(); ++i)
          if (!problem->cones[i].is_free())
            y[i] = std::max(y[i], 0.);
        split(y);
        const double back = opens || is_flat ? 0. : dot(free_gradient, Hp) / pHp;
        changes += opens;
        for (std::size_t i = 0; i < y.size(); ++i)
          p[i] = free_gradient[i] - back * p[i];
        continue;
      }
      ++changes;
      add_multiple(y, -longest, p);
      add_multiple(g, -longest, Hp);
      for (std::size_t i = 0; i < y.size(); ++i)
        if (!problem->cones[i].is_free() &&
            y[i] <= std::numeric_limits<double>::epsilon() * longest * std::fabs(p[i]))
          y[i] = 0.;
      split(y);
      before = y;
      const double energy_before = energy();
      const std::vector<double> direction = free_gradient;
      for (;;)
      {
        for (std::size_t i = 0; i < y.size(); ++i)
        {
          y[i] = before[i] - step_length / norm * direction[i];
          if (!problem->cones[i].is_free())
            y[i] = std::max(y[i], 0.);
        }
        set_gradient();
        if (energy() <= energy_before + known * std::fabs(energy_before) ||
            products >= most_products)
          break;
        norm *= 2.;
      }
    }
    return products < most_products;
  }

  bool Mprgp::solve(const MixedComplementarityProblem &given, const ComplementarityOperator &F,
                    MixedComplementaritySolution &solution)
  {
    problem = &given;
    matrix = &F;
    products = changes = 0;
    factor = 0.;
    const std::size_t n = given.size();
    for (std::vector<double> *const v :
         {&scale, &multiplier, &g, &free_gradient, &reduced, &chopped})
      v->assign(n, 0.);
    for (std::size_t i = 0; i < n; ++i)
      scale[i] = F.diagonal(i) > 0. ? 1. / std::sqrt(F.diagonal(i)) : 0.;
    // A pseudo-inverse may leave no diagonal entry to a row that a null space vector moves.
    const std::vector<char> in_null_space = given.rows_in_null_space();
    double mean = 0.;
    for (std::size_t i = 0; i < n; ++i)
      mean += F.diagonal(i) / n;
    for (std::size_t i = 0; i < in_null_space.size(); ++i)
      if (in_null_space[i] && !(F.diagonal(i) > least_diagonal * mean))
        scale[i] = mean > 0. ? 1. / std::sqrt(mean) : 1.;
    std::vector<char> takes_part(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      takes_part[i] = given.cones[i].is_free() || given.cones[i].may_open();
      scale[i] = takes_part[i] ? scale[i] : 0.;
    }

    std::vector<std::size_t> free;
    held = {};
    held.cones = given.cones;
    held.free_gap = given.free_gap;
    std::vector<double> d = given.free_gap;
    for (std::size_t k = 0; k < given.n_null_space(); ++k)
      if (const double E = given.resistance(k); E > 0.)
        given.null_space[k].add_to(given.null_space_load[k] / E, d);
      else
      {
        free.push_back(k);
        held.null_space.push_back(given.null_space[k]);
        held.null_space_load.push_back(given.null_space_load[k]);
      }
    penalty = free.empty() ? nullptr : std::make_unique<NullSpacePenalty>(held, F, takes_part);
    find_norm();
    factor = norm > 0. ? norm : 1.;
    norm += penalty ? factor : 0.;
    norm = norm > 0. ? norm : 1.;

    std::vector<double> y(n, 0.), linear, amplitude(free.size(), 0.), N(n, 0.);
    const auto set_multipliers = [&]
    {
      for (std::size_t i = 0; i < n; ++i)
        N[i] = scale[i] * y[i];
    };
    const auto set_linear_term = [&](const std::vector<double> &alpha)
    {
      linear = d;
      for (std::size_t k = 0; k < free.size(); ++k)
        held.null_space[k].add_to(alpha[k], linear);
      for (std::size_t i = 0; i < n; ++i)
        linear[i] *= scale[i];
    };
    bool has_minimum = true;
    if (free.empty())
    {
      set_linear_term({});
      has_minimum = descend(linear, known * length(linear), y);
      set_multipliers();
    }
    else
    {
      std::vector<double> raised = penalty->weigh(held.null_space_load);
      set_linear_term(std::vector<double>(free.size(), 0.));
      const double of_gaps = length(linear);
      for (double &value : raised)
        value *= factor;
      set_linear_term(raised);
      const double size = std::max(of_gaps, length(linear));
      double wanted = .1 * size;
      bool is_balanced = false;
      for (unsigned int update = 0; update < most_balance_updates && has_minimum && !is_balanced;
           ++update)
      {
        std::vector<double> alpha = amplitude;
        add_multiple(alpha, 1., raised);
        set_linear_term(alpha);
        has_minimum = descend(linear, wanted, y);
        set_multipliers();
        std::vector<double> more = penalty->weigh(penalty->unbalance(N));
        add_multiple(amplitude, factor, more);
        is_balanced = wanted <= known * size && penalty->unbalanced(N, known).empty();
        wanted = std::max(.1 * wanted, known * size);
      }
      has_minimum = has_minimum && is_balanced;
    }
    if (!has_minimum)
      return false;

    solution.reset(given);
    solution.multiplier = N;
    for (std::size_t k = 0; k < given.n_null_space(); ++k)
      if (const double E = given.resistance(k); E > 0.)
        solution.mode_amplitude[k] = (given.null_space[k].dot(N) + given.null_space_load[k]) / E;
    for (std::size_t k = 0; k < free.size(); ++k)
      solution.mode_amplitude[free[k]] = amplitude[k];
    final_residual = close_rows(given, F, solution);
    return true;
  }
} // namespace taut
