// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the mean force of cables keeps the energy of a motion at any step, where forces at the
// ends of steps make energy out of nothing. Expected values: conservation of energy.
#include "verification/run.h"

#include <taut/base/dot.h>
#include <taut/cable/cable.h>
#include <taut/substructure/local_solver.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{
  using namespace taut;

  /// A slack span of 8 m, at rest in its catenary turned into the horizontal plane.
  CableData slack_span(const CableElement element, const double damping)
  {
    CableData data;
    data.name = "span";
    data.to = {8., 0., 0.};
    data.length = 10.;
    data.section = {1e6, element == CableElement::ancf ? 1. : 0., 1., damping};
    data.gravity = {0., -9.81, 0.};
    data.n_elements = 32;
    data.element = element;
    return data;
  }

  struct Motion
  {
    double start_energy = 0., largest_change = 0., largest_rise = 0.;
    double lowest = 0.; ///< y of the middle [m]
    double iterations = 0.;
  };

  /// The energy-momentum scheme with Newton's method on the increment.
  Motion swing(const Cable &cable, const double step, const double end)
  {
    std::vector<double> U(cable.n_dofs(), 0.), P, V = U, increment = U, f, r;
    const std::vector<double> q = cable.positions(U);
    for (std::size_t i = 0; i < q.size(); i += 3) // about the chord
    {
      U[i + 1] = -q[i + 1];
      U[i + 2] = q[i + 1];
    }
    for (const unsigned int i : cable.constrained_dofs())
      U[i] = 0.;
    cable.external_force(0., P);
    const auto energy = [&]
    {
      std::vector<double> p(V.size(), 0.);
      cable.mass().vmult_add(.5, V.data(), p.data());
      return dot(V, p) + cable.strain_energy(U) - dot(P, U);
    };
    const auto solver = make_local_solver("block tridiagonal", cable.mass());
    Motion motion;
    motion.start_energy = energy();
    double before = motion.start_energy;
    const int n_steps = std::lround(end / step);
    for (int k = 0; k < n_steps; ++k)
    {
      for (std::size_t i = 0; i < U.size(); ++i)
        increment[i] = step * V[i];
      double size = 1.;
      for (int iteration = 0; size > 1e-5; ++iteration)
      {
        if (iteration == 50)
        {
          ADD_FAILURE() << "no convergence in step " << k;
          return motion;
        }
        std::vector<double> next = U, middle = U, inertia = increment;
        for (std::size_t i = 0; i < U.size(); ++i)
        {
          next[i] += increment[i];
          middle[i] += .5 * increment[i];
          inertia[i] -= step * V[i];
        }
        cable.mean_internal_force(U, next, step, f);
        r = P;
        cable.mass().vmult_add(-2. / (step * step), inertia.data(), r.data());
        for (std::size_t i = 0; i < U.size(); ++i)
          r[i] -= f[i];
        for (const unsigned int i : cable.constrained_dofs())
          r[i] = 0.;
        size = 0.;
        for (const double force : r)
          size = std::max(size, std::fabs(force));
        const auto K = cable.tangent(middle, 2. / step, false);
        solver->factor({{2. / (step * step), &cable.mass()}, {.5, K.get()}},
                       cable.constrained_dofs());
        solver->solve(r);
        for (std::size_t i = 0; i < U.size(); ++i)
          increment[i] += r[i];
        motion.iterations += 1. / n_steps;
      }
      for (std::size_t i = 0; i < U.size(); ++i)
      {
        U[i] += increment[i];
        V[i] = 2. * increment[i] / step - V[i];
      }
      const double now = energy();
      motion.largest_change = std::max(motion.largest_change, std::fabs(now - motion.start_energy));
      motion.largest_rise = std::max(motion.largest_rise, now - before);
      motion.lowest = std::min(motion.lowest, cable.elements().position(cable.positions(U), 5.).y);
      before = now;
    }
    return motion;
  }

  TEST(CableMotions, EnergyStaysInALargeMotion)
  {
    for (const CableElement element : {CableElement::ancf, CableElement::bar})
      for (const double step : {5e-3, 2e-3})
      {
        const Cable cable(slack_span(element, 0.));
        const Motion motion = swing(cable, step, 1.5);
        const std::string what = std::string(element == CableElement::ancf ? "ANCF" : "bars") +
                                 ", step " + std::to_string(1e3 * step).substr(0, 1) + " ms";
        // It falls from the height of its ends to below the catenary's lowest point, near 2.6 m.
        const double scale = 10. * 9.81 * 2.;
        EXPECT_LT(motion.lowest, -2.5);
        verification::figure("change of energy of a slack span, " + what,
                             motion.largest_change / scale);
        verification::figure("iterations a step of a slack span, " + what, motion.iterations);
        EXPECT_LT(motion.largest_change, 1e-8 * scale) << what;
      }
  }

  TEST(CableMotions, DampingOnlyTakesEnergy)
  {
    const Cable cable(slack_span(CableElement::ancf, 1e3)); // 1 ms of EA
    const Motion motion = swing(cable, 5e-3, 1.5);
    EXPECT_LT(motion.largest_rise, 1e-7);
    EXPECT_GT(motion.largest_change, 1e-2);
  }
} // namespace
