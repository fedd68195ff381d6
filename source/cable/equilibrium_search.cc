// SPDX-License-Identifier: LGPL-2.1-or-later
#include "equilibrium_search.h"

#include <taut/base/dot.h>
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    constexpr unsigned int most_iterations = 60;
    constexpr int most_polishing = 4;
    constexpr double enough = 1e-4; ///< of the expected decrease of the energy (Armijo)

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
      const double h = cable.element_length();
      return 8. * eps * (section.axial_stiffness + section.bending_stiffness / (h * h)) *
             (1. + size / h);
    }
  } // namespace

  EquilibriumSearch::EquilibriumSearch(const CableElements &cable,
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
    CableElements(cable.element(), cable.length(), cable.n_elements(), one).add_mass(1., *M);
  }

  bool EquilibriumSearch::solve(const CableElements &cable, const double relative_tolerance,
                                std::vector<double> &q)
  {
    const std::vector<double> start = q;
    for (const bool downhill : {false, true})
    {
      q = start;
      if (iterate(cable, relative_tolerance, downhill, q))
        return true;
    }
    q = start;
    return false;
  }

  /// The unbalanced forces, and the largest of them.
  double EquilibriumSearch::find_residual(const CableElements &cable, const std::vector<double> &q)
  {
    cable.internal_force(q, {}, r);
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] = load[i] - r[i];
    for (const unsigned int i : held)
      r[i] = 0.;
    return largest(cable, r);
  }

  double EquilibriumSearch::energy(const CableElements &cable, const std::vector<double> &q) const
  {
    return cable.strain_energy(q) - dot(load, q);
  }

  /// True if the tangent with @p mu times the mass matrix is positive definite.
  bool EquilibriumSearch::factor(const CableElements &cable, const std::vector<double> &q,
                                 const bool definite, const double mu)
  {
    const auto K = make_block_tridiagonal(CableElements::dofs_per_node, cable.n_dofs());
    cable.add_tangent(q, definite, *K);
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

  bool EquilibriumSearch::iterate(const CableElements &cable, const double relative_tolerance,
                                  const bool downhill, std::vector<double> &q)
  {
    double scale = largest(cable, load);
    double size = find_residual(cable, q);
    if (scale == 0.)
      scale = size;
    for (unsigned int k = 0; k < most_iterations; ++k)
    {
      last_residual = size;
      balanced = size <= std::max(relative_tolerance * scale, rounding(cable, q));
      if (balanced)
      {
        polish(cable, size, q);
        return factor(cable, q, false, 0.);
      }
      ++n_iterations;
      if (!step(cable, downhill, size, q))
        return false;
    }
    return false;
  }

  /// Makes one step; returns false if there is no step.
  bool EquilibriumSearch::step(const CableElements &cable, const bool downhill, double &size,
                               std::vector<double> &q)
  {
    if (!factor(cable, q, false, 0.))
    {
      double mu = 1e-8 * cable.section().axial_stiffness / std::pow(cable.element_length(), 2);
      int trials = 0;
      for (; trials < 30 && !factor(cable, q, true, mu); ++trials)
        mu *= 10.;
      if (trials == 30)
        return false;
    }
    std::vector<double> direction = r;
    solver->solve(direction);
    const std::vector<double> start = q;
    const double slope = dot(r, direction), start_energy = downhill ? energy(cable, q) : 0.,
                 start_size = size;
    for (double length = 1.; length > 1e-9; length *= .5)
    {
      for (std::size_t i = 0; i < q.size(); ++i)
        q[i] = start[i] + length * direction[i];
      size = find_residual(cable, q);
      if (!std::isfinite(size))
        continue;
      if (!downhill || energy(cable, q) <= start_energy - enough * length * slope)
        return true;
      // Close to the equilibrium the energy is constant to rounding.
      if (length == 1. && slope < 1e-9 * std::fabs(start_energy) && size < start_size)
        return true;
    }
    return false;
  }

  /// Makes steps until rounding ends them.
  void EquilibriumSearch::polish(const CableElements &cable, double size, std::vector<double> &q)
  {
    std::vector<double> best = q;
    double least = size;
    for (int k = 0; k < most_polishing && step(cable, false, size, q) && size < .5 * least; ++k)
    {
      best = q;
      least = size;
    }
    q = best;
    last_residual = find_residual(cable, q);
  }
} // namespace taut
