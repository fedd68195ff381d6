// SPDX-License-Identifier: LGPL-2.1-or-later
// What the tests of scenes need.
#ifndef taut_verification_scene_tests_h
#define taut_verification_scene_tests_h

#include "common.h"
#include "run.h"

namespace verification
{
  /// What @p value finds at the start and after each step of a scene.
  template <typename Value>
  auto series(const std::string &file_or_text, const Overrides &overrides, const Value &value)
  {
    std::vector<decltype(value(std::declval<const taut::StepView &>()))> result;
    run_scene(file_or_text, overrides,
              [&](const taut::StepView &view) { result.push_back(value(view)); });
    return result;
  }

  /// Kinetic and strain energy of linear bodies, by M and K [J].
  inline double energy_of_bodies(const taut::Structure &structure, const taut::State &state)
  {
    double sum = 0.;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const std::vector<double> &U = state.U[k], &V = state.V[k];
      std::vector<double> MV(U.size(), 0.), KU(U.size(), 0.);
      structure[k].mass().vmult_add(1., V.data(), MV.data());
      structure[k].stiffness().vmult_add(1., U.data(), KU.data());
      for (std::size_t i = 0; i < U.size(); ++i)
        sum += .5 * (MV[i] * V[i] + KU[i] * U[i]);
    }
    return sum;
  }
} // namespace verification

#endif
