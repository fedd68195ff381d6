// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_shared_places_h
#define taut_shared_places_h

#include <taut/scene/scene.h>

namespace taut
{
  /// Largest distance of two places on a wire that count as one place: 1e-6 of an element [m].
  double same_place(const Wire &wire);

  /**
   * Moves items of a wire that are nearly at one place to a common place, so that they share a node
   * of the grid. Items are supports, point masses, fixed link ends, point loads, ends of parts with
   * another tension and the ends of the wire. Their distance must be below same_place(). It must
   * also be below 1e-6 of the place, as for digits that were not written, or below 1e-8 of the
   * length of the wire.
   *
   * Bodies with PlacesByX::divided() get nodes at fixed link ends and point loads.
   */
  void share_places(Scene &scene);
} // namespace taut

#endif
