// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_parameters_h
#define taut_parameters_h

#include <taut/output/statistics.h>
#include <taut/scene/scene_generator.h>
#include <taut/time/integrator.h>
#include <taut/time/solver_parameters.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// Everything a parameter file says. Members hold the defaults until read() has run.
  class Parameters
  {
  public:
    /**
     * Reads a .prm file; @p overrides are "Section.Entry=value" and come last. Unknown entries are
     * errors. Throws UserError with file and line.
     */
    void read(const std::string &file, const std::vector<std::string> &overrides);

    /// The scene of the generator, checked.
    Scene scene() const;

    std::string generator_name = "network";
    std::vector<double> gravity = {0., -9.81};
    std::string start = "equilibrium";

    std::string scheme = "automatic";
    double step = 1e-3, end_time = 1.;

    std::string folder = "results";
    double interval = 0., link_interval = 0.;

    SolverParameters solver;
    StatisticsParameters statistics;

    /// The scheme of this name with its parameters.
    const TimeIntegrator &integrator(const std::string &name) const
    {
      return *integrators.at(name);
    }

  private:
    void declare_general(dealii::ParameterHandler &prm);

    std::unique_ptr<SceneGenerator> generator;
    std::map<std::string, std::unique_ptr<TimeIntegrator>> integrators;
  };
} // namespace taut

#endif
