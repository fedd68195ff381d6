// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_constraints_h
#define taut_scene_constraints_h

#include <taut/interface/constraints.h>
#include <taut/interface/interface_parameters.h>
#include <taut/model/scene_bodies.h>

namespace taut
{
  /// The constraints of a scene: links in their order, contacts of surfaces, and cuts. Scene and
  /// bodies are kept by reference; @p bodies must be made from @p scene, or from a scene with more
  /// links. Cuts are distributed if those of a body are. Called by all ranks together.
  Constraints scene_constraints(const Scene &scene, const SceneBodies &bodies);

  /// Lets each rank have the cuts of its own bodies, and at rest all fixed rows, where this suits
  /// the representation of F; all ranks have all rows elsewhere. Called by all ranks together.
  void choose_rows(Constraints &constraints, const InterfaceParameters &parameters,
                   const SceneBodies &bodies, bool is_at_rest);
} // namespace taut

#endif
