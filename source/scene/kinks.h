// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_kinks_h
#define taut_kinks_h

#include <taut/scene/scene.h>

namespace taut
{
  /**
   * Adds the pull of wires under tension whose ends rigid joints hold together as a load of the
   * scene. The load is the sum of T t along the held directions, with the tangent t into each wire.
   * It vanishes where a wire goes straight on with the same tension. Directions that a joint leaves
   * free are held from outside, as at the end of a single wire.
   */
  void add_pulls_of_kinks(Scene &scene);
} // namespace taut

#endif
