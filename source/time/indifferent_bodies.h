// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_indifferent_bodies_h
#define taut_indifferent_bodies_h

#include <taut/substructure/structure.h>

namespace taut
{
  // Both are about the nonlinear bodies of this rank at a displacement U from the undeformed
  // structure [m, rad]. A body that is not slender makes them false.

  /// True if all tangents are definite but for rounding: what a motion costs no energy of is no
  /// tension, as of a cable that lies slack.
  bool are_indifferent(const Structure &structure, const BodyVectors &U);

  /// True if all bodies are in tension but at free ends.
  bool are_in_tension(const Structure &structure, const BodyVectors &U);
} // namespace taut

#endif
