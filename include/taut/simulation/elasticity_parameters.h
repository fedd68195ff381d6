// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_elasticity_parameters_h
#define taut_elasticity_parameters_h

#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Where and how `taut --elasticity` measures a line.
  struct ElasticityParameters
  {
    double force = 100.;       ///< upwards [N]
    double spacing = 1.;       ///< of the places [m]
    std::vector<double> range; ///< first and last x [m]; empty: all of each wire
    bool slackening = false;   ///< links may open and close under the force

    /// Declares the members in subsection "Elasticity".
    void declare_parameters(dealii::ParameterHandler &prm);
  };
} // namespace taut

#endif
