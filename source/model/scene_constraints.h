// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_constraints_h
#define taut_scene_constraints_h

#include <taut/interface/constraints.h>
#include <taut/model/scene_bodies.h>

namespace taut
{
  /// The constraints of a scene: links in their order, and the cuts of wires. Scene and bodies are
  /// kept by reference; @p bodies must be made from @p scene, or from a scene with more links.
  Constraints scene_constraints(const Scene &scene, const SceneBodies &bodies);
} // namespace taut

#endif
