// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/cable_equilibrium.h"

#include "base/dot.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    constexpr int most_iterations = 60;

    /// Residual force over the load.
    constexpr double rough = 1e-3, balance = 1e-10;

    /// The mass that a tangent gets: its first part of the axial stiffness, its growth, and how
    /// often it grows.
    constexpr double first_shift = 1e-8, growth_of_shift = 10.;
    constexpr int most_shifts = 30;

    /// The step that leaves an equilibrium which is not stable, and after how many steps there:
    /// rounding may hide that it is.
    constexpr double part_of_element = .1;
    constexpr int most_unstable = 3;

    bool is_slope(const CableElements &cable, const std::size_t dof)
    {
      return cable.element() == CableElement::ancf && dof % 6 > 2;
    }

    /// The largest force, and moment over the length of an element.
    double largest(const CableElements &cable, const std::vector<double> &forces)
    {
      double result = 0.;
      for (std::size_t i = 0; i < forces.size(); ++i)
      {
        const double size =
            std::fabs(forces[i]) / (is_slope(cable, i) ? cable.element_length() : 1.);
        if (!(size <= result)) // not-a-number remains
          result = size;
      }
      return result;
    }

    /// Rounding error of forces that are in balance.
    double rounding(const CableElements &cable, const std::vector<double> &q)
    {
      double size = 0.;
      for (std::size_t i = 0; i < q.size(); ++i)
        if (!is_slope(cable, i))
          size = std::max(size, std::fabs(q[i]));
      const CableSection &section = cable.section();
      const double h = cable.shortest_element();
      return 8. * eps * (section.axial_stiffness + section.bending_stiffness / (h * h)) *
             (1. + size / h);
    }
  } // namespace

  CableEquilibrium::CableEquilibrium(const CableElements &cable,
                                     const std::vector<unsigned int> &held_dofs,
                                     const std::vector<double> &load)
      : held(held_dofs), load(load),
        solver(make_block_tridiagonal_solver(CableElements::dofs_per_node))
  {
    const std::vector<unsigned int> unused = cable.unused_dofs();
    held.insert(held.end(), unused.begin(), unused.end());
    std::sort(held.begin(), held.end());
    M = make_block_tridiagonal(CableElements::dofs_per_node, cable.n_dofs());
    CableSection one;
    one.mass_per_length = 1.;
    cable.with_section(one).add_mass(1., *M);
  }

  bool CableEquilibrium::find(const CableElements &of, std::vector<double> &positions)
  {
    // Iterations go on until rounding ends them.
    const double least = std::numeric_limits<double>::min();
    return find(of, {least, balance, 1}, positions);
  }

  bool CableEquilibrium::find_roughly(const CableElements &of, std::vector<double> &positions)
  {
    return find(of, {rough, rough, 1}, positions);
  }

  bool CableEquilibrium::find(const CableElements &of, NewtonConvergence::Limits limits,
                              std::vector<double> &positions)
  {
    cable = &of;
    start = positions;
    scale = largest(of, load);
    if (scale == 0.)
      scale = find_residual(start);
    if (scale > 0.)
      limits.stagnated = std::max(limits.stagnated, rounding(of, start) / scale);
    reached = limits.stagnated;
    const NewtonSearch search(limits, most_iterations, most_iterations);
    if (!search.find_or_descend(*this))
      return false;
    positions = q;
    return true;
  }

  void CableEquilibrium::begin()
  {
    q = start;
    n_unstable = 0;
    balanced = false;
    least = std::numeric_limits<double>::infinity();
  }

  /// The unbalanced forces, and the largest of them.
  double CableEquilibrium::find_residual(const std::vector<double> &at)
  {
    cable->internal_force(at, {}, r);
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] = load[i] - r[i];
    for (const unsigned int i : held)
      r[i] = 0.;
    return largest(*cable, r);
  }

  double CableEquilibrium::energy(const std::vector<double> &at) const
  {
    return cable->strain_energy(at) - dot(load, at);
  }

  /// True if the tangent with @p mu times the mass matrix is positive definite.
  bool CableEquilibrium::factor(const bool definite, const double mu)
  {
    const auto K = make_block_tridiagonal(CableElements::dofs_per_node, cable->n_dofs());
    cable->add_tangent(q, definite, *K);
    try
    {
      solver->factor({{1., K.get()}, {mu, M.get()}}, held);
    }
    catch (const BodyNotHeld &)
    {
      return false;
    }
    return true;
  }

  /// Factors the tangent with as much mass as makes it definite. False if none does.
  bool CableEquilibrium::factor_shifted(const bool definite)
  {
    double mu =
        first_shift * cable->section().axial_stiffness / std::pow(cable->element_length(), 2);
    for (int shift = 0; shift < most_shifts; ++shift, mu *= growth_of_shift)
      if (factor(definite, mu))
        return true;
    return false;
  }

  /// The error is the least residual force so far; 1 of an equilibrium that is not stable, which
  /// the search leaves the way that costs least.
  double CableEquilibrium::solve()
  {
    last_residual = find_residual(q);
    const bool is_stable = factor(false, 0.), is_balance = last_residual <= reached * scale;
    balanced = balanced || is_balance;
    n_unstable = is_balance && !is_stable ? n_unstable + 1 : 0;
    if (n_unstable == 0 && !(last_residual >= least))
    {
      best = q;
      least = last_residual;
    }
    const bool leaves = n_unstable > most_unstable;
    if (!is_stable && !factor_shifted(!leaves))
      return std::numeric_limits<double>::quiet_NaN();
    direction = r;
    if (leaves)
      set_unstable_direction();
    else
      solver->solve(direction);
    move(1.);
    if (n_unstable > 0)
      return 1.;
    return last_residual > 0. ? least / scale : last_residual;
  }

  /// One inverse iteration, from any vector, towards the lowest vibration.
  void CableEquilibrium::set_unstable_direction()
  {
    constexpr int irregular = 7, range = 13;
    for (std::size_t i = 0; i < direction.size(); ++i)
      direction[i] = static_cast<int>(irregular * i * i % range) - range / 2;
    for (const unsigned int i : held)
      direction[i] = 0.;
    solver->solve(direction);
    double size = 0.;
    for (std::size_t i = 0; i < direction.size(); ++i)
      if (!is_slope(*cable, i))
        size = std::max(size, std::fabs(direction[i]));
    for (double &x : direction)
      x *= part_of_element * cable->element_length() / size;
  }

  void CableEquilibrium::go_on()
  {
    q.swap(solution);
    ++n_iterations;
  }

  bool CableEquilibrium::accept()
  {
    q = best;
    last_residual = least;
    return factor(false, 0.);
  }

  DescentProblem::Descent CableEquilibrium::descent()
  {
    return {energy(q), -dot(r, direction)};
  }

  double CableEquilibrium::shorten_to(const double s)
  {
    move(s);
    return energy(solution);
  }

  void CableEquilibrium::move(const double s)
  {
    solution = q;
    for (std::size_t i = 0; i < q.size(); ++i)
      solution[i] += s * direction[i];
  }
} // namespace taut
