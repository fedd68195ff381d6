// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rest_limits_h
#define taut_rest_limits_h

#include <taut/model/scene_bodies.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * Warnings about wires that hang too deep at the start for equations of small slopes: a slope of
   * more than 0.2 rad, where a wire is 2 % longer than its straight line, or a sag between two
   * supports of more than a tenth of their distance. At most one of each kind, about the worst
   * wire.
   * @p start has the displacements at the start. Called by all ranks together.
   */
  std::vector<std::string> warnings_at_rest(const Scene &scene, const SceneBodies &structure,
                                            const BodyVectors &start);

  /// A warning for each wire whose droppers from another wire are all slack; wires with the same
  /// droppers have one. @p forces [N] and @p gaps [m] are those of the links.
  std::vector<std::string> warnings_of_slack_droppers(const Scene &scene,
                                                      const std::vector<double> &forces,
                                                      const std::vector<double> &gaps);
} // namespace taut

#endif
