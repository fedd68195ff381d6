// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_tests_first_frequency_h
#define taut_tests_first_frequency_h

#include "common.h"

#include "base/dot.h"
#include <taut/substructure/local_solver.h>
#include <taut/substructure/substructure.h>

namespace verification
{
  /// The first circular frequency of a body by inverse iteration [rad/s].
  inline double first_frequency(const taut::Substructure &body)
  {
    std::vector<double> x(body.n_dofs(), 1.);
    const auto solver = taut::make_local_solver("sparse direct", body.stiffness());
    solver->factor({{1., &body.stiffness()}}, body.constrained_dofs());
    double omega2 = 0.;
    for (int iteration = 0; iteration < 30; ++iteration)
    {
      const std::vector<double> Mx = matrix_times(body.mass(), x);
      x = Mx;
      solver->solve(x);
      const double yMy = taut::dot(x, matrix_times(body.mass(), x));
      omega2 = taut::dot(x, Mx) / yMy;
      for (double &value : x)
        value /= std::sqrt(yMy);
    }
    return std::sqrt(omega2);
  }
} // namespace verification

#endif
