// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_values_h
#define taut_scene_values_h

#include <taut/scene/scene.h>

#include <string>

namespace taut
{
  /**
   * All values of a scene as bytes, a key for SharedParts. Two scenes have the same bytes if and
   * only if they agree in every number to the last bit, every name and every formula. Do not use it
   * for scenes with bodies of plugins, which are no plain values.
   */
  std::string values_of(const Scene &scene);
} // namespace taut

#endif
