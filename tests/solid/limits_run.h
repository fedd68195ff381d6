// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solid_limits_run_h
#define taut_solid_limits_run_h

#include "verification/scene_tests.h"

#include "model/surface_constraints.h"

#include <nlohmann/json.hpp>

namespace solid_limits
{
  using verification::has;
  using verification::Overrides;

  struct Ran
  {
    std::vector<double> forces;                       ///< of all constraints, in the last step
    std::vector<double> peaks;                        ///< of all constraints, the largest so far
    std::vector<taut::SurfaceConstraint> constraints; ///< of all contacts
    std::vector<std::string> warnings;                ///< kinds
    std::string log, error;
  };

  inline Ran run(const std::string &text, const Overrides &overrides = {})
  {
    Ran result;
    const std::string refusal = verification::error_of(
        [&]
        {
          verification::Session session(text, overrides);
          result.error = verification::error_of(
              [&]
              {
                session.run(
                    [&](const taut::StepView &view)
                    {
                      result.forces = view.state.multiplier;
                      result.peaks.resize(result.forces.size(), 0.);
                      for (std::size_t i = 0; i < result.peaks.size(); ++i)
                        result.peaks[i] = std::fmax(result.peaks[i], result.forces[i]);
                      result.constraints.clear();
                      for (std::size_t c = 0; c < view.scene.contacts.size(); ++c)
                        for (const auto &row : taut::contact_geometry(view.scene, c).constraints)
                          result.constraints.push_back(row);
                    });
              });
          result.log = session.log();
          if (std::ifstream file(session.folder() + "/statistics.json"); file)
          {
            const nlohmann::json all = nlohmann::json::parse(file);
            for (const auto &warning : all.at("warnings"))
              result.warnings.push_back(warning.at("kind"));
          }
        });
    if (!refusal.empty())
      result.error = refusal;
    return result;
  }

  inline std::string body(const std::string &name, const std::string &cells,
                          const std::string &more = "")
  {
    return "Body " + name +
           ": Type = solid; Young's modulus = 1e9; Poisson's ratio = 0; Density = 2000; " + more +
           "\nBody " + name + "/Mesh: " + cells + "\n";
  }

  inline std::string box(const std::string &name, const std::string &arguments,
                         const std::string &more)
  {
    return body(name, "Arguments = " + arguments, more);
  }

  inline std::string scene(const std::string &start, const std::string &bodies,
                           const std::string &rest)
  {
    return "Generator = network; Gravity = 0, 0; Start = " + start + "\n" + bodies + "\n" + rest;
  }

  inline std::string contact(const std::string &slave, const std::string &master,
                             const std::string &more = "")
  {
    return "Contact pair: Slave = " + slave + "; Master = " + master + "; " + more + "\n";
  }

  const std::string at_rest = "Time: End = 0\n", steps = "Time: Step = 1e-5; End = 2e-4\n";

  /// A block from y = 0 to @p top below one from @p bottom on, pressed down.
  inline std::string stack(const std::string &top, const std::string &bottom)
  {
    return scene("given",
                 box("lower", "4, 3 : 0, 0 : 1, " + top, "Fixed boundaries = 2") +
                     box("upper", "3, 3 : 0, " + bottom + " : 1, 0.6", "Traction = 3: 0, -1e5"),
                 contact("upper: 2", "lower: 3") + steps);
  }
} // namespace solid_limits

#endif
