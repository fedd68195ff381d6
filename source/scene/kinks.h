// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_kinks_h
#define taut_kinks_h

#include <taut/scene/scene.h>

namespace taut
{
  /**
   * Where rigid joints hold ends of wires under tension together, their pull is a load of the
   * scene: the sum of T t, t the tangent into each wire, along the directions that are held. It
   * vanishes where a wire goes on straight with the same tension. What a joint leaves free stays
   * held from outside, as at the end of a wire alone.
   */
  void add_pulls_of_kinks(Scene &scene);
} // namespace taut

#endif
