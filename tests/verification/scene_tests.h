// SPDX-License-Identifier: LGPL-2.1-or-later
// What the tests of scenes need.
#ifndef taut_verification_scene_tests_h
#define taut_verification_scene_tests_h

#include "common.h"
#include "run.h"

namespace verification
{
  /// Kinetic and strain energy of linear bodies, by M and K [J].
  inline double energy_of_bodies(const taut::Structure &structure, const taut::State &state)
  {
    double sum = 0.;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const std::vector<double> &U = state.U[k], &V = state.V[k];
      const std::vector<double> MV = matrix_times(structure[k].mass(), V),
                                KU = matrix_times(structure[k].stiffness(), U);
      for (std::size_t i = 0; i < U.size(); ++i)
        sum += .5 * (MV[i] * V[i] + KU[i] * U[i]);
    }
    return sum;
  }
} // namespace verification

#endif
