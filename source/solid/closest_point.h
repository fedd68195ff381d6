// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_closest_point_h
#define taut_closest_point_h

#include "solid/surface_geometry.h"

#include <array>
#include <optional>
#include <set>

namespace taut
{
  /// A place on a surface, closest to a point.
  struct ClosestPoint
  {
    std::size_t face = 0;
    ReferencePoint reference;
    double distance = 0.;        ///< not negative [m]
    bool on_border = false;      ///< of the face
    bool on_open_border = false; ///< of the surface
  };

  /// Closest points on faces, by Newton's method inside a face and along its edges.
  class ClosestPoints
  {
  public:
    /// Keeps a reference.
    explicit ClosestPoints(const SurfaceGeometry &geometry);

    /// On one face.
    ClosestPoint find(std::size_t face, const Coordinates &x) const;

  private:
    std::optional<ReferencePoint> inside(std::size_t face, const Coordinates &x) const;
    ReferencePoint on_line(std::size_t face, const Coordinates &x, const ReferencePoint &begin,
                           const ReferencePoint &end) const;
    void find_in_plane(ClosestPoint &closest, const Coordinates &x) const;
    void find_in_space(ClosestPoint &closest, const Coordinates &x) const;

    const SurfaceGeometry &geometry;
    std::set<std::array<unsigned int, 2>> single_edges; ///< in space: of one face only
    std::set<unsigned int> border_nodes;                ///< ends of the surface, and of these edges
  };
} // namespace taut

#endif
