// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_tests_slack_cable_h
#define taut_tests_slack_cable_h

#include "common.h"

#include <taut/cable/cable.h>
#include <taut/substructure/local_solver.h>

namespace verification
{
  using namespace taut;

  inline CableData slack_cable(const CableElement element = CableElement::ancf)
  {
    CableData data;
    data.name = "cable";
    data.origin = "Body cable";
    data.from = {100., 20., -3.};
    data.to = {160., 20., -3.};
    data.length = 78.;
    data.section = {1.3e7, 0., 1.07, 0.};
    data.gravity = {0., -9.81, 0.};
    data.n_elements = 32;
    data.element = element;
    return data;
  }

  inline std::vector<double> unbalanced(const Cable &cable, const std::vector<double> &U)
  {
    std::vector<double> f, P;
    cable.internal_force(U, {}, f);
    cable.external_force(0., P);
    for (std::size_t i = 0; i < P.size(); ++i)
      P[i] -= f[i];
    return P;
  }

  inline double largest_of(std::vector<double> x, const std::vector<unsigned int> &left_out)
  {
    for (const unsigned int i : left_out)
      x[i] = 0.;
    return largest(x);
  }

  inline std::vector<double> equilibrium(const Cable &cable)
  {
    std::vector<double> U(cable.n_dofs(), 0.);
    const auto solver = make_local_solver("block tridiagonal", cable.stiffness());
    for (int k = 0; k < 100; ++k)
    {
      std::vector<double> step = unbalanced(cable, U);
      if (largest_of(step, cable.constrained_dofs()) < 1e-6)
        return U;
      const auto K = cable.tangent(U, {}, 0., true);
      solver->factor({{1., K.get()}, {k < 20 ? 1. : 0., &cable.mass()}}, cable.constrained_dofs());
      solver->solve(step);
      for (std::size_t i = 0; i < U.size(); ++i)
        U[i] += step[i];
    }
    ADD_FAILURE() << "no equilibrium";
    return U;
  }
} // namespace verification

#endif
