// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_free_bodies_h
#define taut_free_bodies_h

#include <taut/interface/constraints.h>

#include <vector>

namespace taut
{
  /**
   * The bodies with a motion that costs nothing and that no constraint in @p constraints opposes,
   * where those count that are bilateral or carry a multiplier: bodies of this rank that are
   * joined, directly or through others, neither to a body that is held nor to the ground, and those
   * whose own constraints leave one of their motions free. What several bodies can only do together
   * while constraints to the ground leave it free is not seen.
   */
  std::vector<char> free_bodies(const std::vector<Substructure::NullSpace> &null_spaces,
                                const Constraints &constraints,
                                const std::vector<double> &multiplier);
} // namespace taut

#endif
