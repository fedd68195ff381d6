// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_wires_at_rest_h
#define taut_wires_at_rest_h

#include "model/found_droppers.h"
#include <taut/base/communicator.h>
#include <taut/interface/constraints.h>
#include <taut/model/scene_bodies.h>
#include <taut/time/static_equilibrium.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * The static state of the wires and droppers of a scene, for form finding. Long wires are cut:
   * the responses of a whole one are as long as it is, and a local one then has no digits beside
   * them, so that iterations grow with the length of the wire. The pieces are shared by the ranks,
   * each of which has all results. Called by all ranks together.
   */
  class WiresAtRest
  {
  public:
    WiresAtRest(const Scene &scene, const SolverParameters &parameters,
                const Communicator &processes);

    /// The force in a link [N].
    double multiplier(const std::size_t link) const { return forces[link]; }

    /// Distances of the ends of droppers along a direction for each [m].
    std::vector<double> distances(const std::vector<FoundDropper> &droppers,
                                  const std::vector<Coordinates> &directions) const;

  private:
    const SceneBodies structure;
    const Constraints constraints;
    const StaticState state;
    const std::vector<double> forces; ///< of the links [N]
  };
} // namespace taut

#endif
