// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_rows_h
#define taut_scene_rows_h

#include <taut/interface/contact_rows.h>
#include <taut/model/scene_bodies.h>

namespace taut
{
  /// The rows of a scene: links in their order, and the cuts of wires. Both are kept by reference;
  /// @p bodies were made from @p scene, or from one with more links.
  ContactRows scene_rows(const Scene &scene, const SceneBodies &bodies);
} // namespace taut

#endif
