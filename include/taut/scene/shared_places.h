// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_shared_places_h
#define taut_shared_places_h

#include <taut/scene/scene.h>

namespace taut
{
  /// Distance of two places on a wire up to which they are meant to be one: 1e-6 of an element [m].
  double same_place(const Wire &wire);

  /**
   * Moves supports, point masses, fixed link ends and point loads of a wire that are closer than
   * same_place() to another one, or to an end of the wire, so that they share a node of its grid:
   * if the distance is also below 1e-6 of the place, as that of digits which were not written, or
   * below 1e-8 of the length of the wire.
   */
  void share_places(Scene &scene);
} // namespace taut

#endif
