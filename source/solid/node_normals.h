// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_node_normals_h
#define taut_node_normals_h

#include "solid/surface_geometry.h"

#include <array>
#include <vector>

namespace taut
{
  /// Outer unit normals of faces at their nodes, not averaged between faces.
  class NodeNormals
  {
  public:
    explicit NodeNormals(const SurfaceGeometry &geometry);

    /// At a node of a face, in the order of the face's nodes.
    const Coordinates &at(const std::size_t face, const std::size_t local) const
    {
      return normals[face][local];
    }

  private:
    std::vector<std::vector<Coordinates>> normals;
  };
} // namespace taut

#endif
