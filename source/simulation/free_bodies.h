// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_free_bodies_h
#define taut_free_bodies_h

#include <taut/interface/constraints.h>
#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * The bodies of this rank with a motion without energy that nothing opposes. Bilateral
   * constraints count, and unilateral ones with a multiplier. A body is free if they join it to
   * neither a held body nor the ground, directly or through others. It is also free if its own
   * constraints leave one of its motions free. Motions that several bodies have only together,
   * with constraints to the ground, are not found. Called by all ranks together.
   */
  std::vector<char> free_bodies(const Structure &structure,
                                const std::vector<Substructure::NullSpace> &null_spaces,
                                const Constraints &constraints,
                                const std::vector<double> &multiplier);

  /// A warning for each wire under tension that no support, link or bedding holds across it. A
  /// scene may have such wires, but hardly means them: they fall as a whole.
  std::vector<std::string> warnings_of_unheld_wires(const Scene &scene);
} // namespace taut

#endif
