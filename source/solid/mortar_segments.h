// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mortar_segments_h
#define taut_mortar_segments_h

#include "solid/face_search.h"
#include "solid/overlap.h"
#include "solid/surface_geometry.h"

#include <array>
#include <vector>

namespace taut
{
  /// A part of a slave edge and the master edge that it faces.
  struct MortarSegment
  {
    std::size_t master = 0;      ///< face of the master surface
    double begin = 0., end = 0.; ///< on the reference edge of the slave, begin < end
  };

  /**
   * Segments of two surfaces in the plane (segment-to-segment). Points of a slave edge see along
   * nodal normals, interpolated between the nodes. Nodal normals are averaged over the edges that
   * meet at a node, unless the edges make a corner. The nearest master edge on this line counts, if
   * it faces the slave. It is in front, or behind by an overlap that Overlap closes.
   */
  class MortarSegments
  {
  public:
    /// Keeps references. @p distance is how far a point sees [m].
    MortarSegments(const SurfaceGeometry &slave, const SurfaceGeometry &master, double distance,
                   const WholeBoundaries &boundaries);

    /// Segments of a slave edge, ascending; they do not overlap. Throws UserError for bodies that
    /// overlap too deeply.
    std::vector<MortarSegment> segments(std::size_t face) const;

    /// Throws the UserError for a place of a slave edge that is in the master too deeply.
    void check_overlap(std::size_t face, double slave, bool no_contact = false) const;

    /// Place on the master edge that a point of a segment sees, on the reference edge.
    double project(std::size_t face, double slave, std::size_t master) const;

  private:
    struct Ray
    {
      Coordinates begin, direction; ///< on the slave edge; outwards, about a unit vector
      Coordinates tangent, turn;    ///< their derivatives
    };

    void average_normals();
    Ray ray(std::size_t face, double slave) const;
    double slave_of(std::size_t face, const Coordinates &x) const;
    std::vector<std::size_t> candidates(std::size_t face) const;
    double gap_of(std::size_t face, double slave, std::size_t master) const;

    const SurfaceGeometry &slave, &master;
    double distance;
    FaceSearch search;
    Overlap overlap;
    std::vector<std::array<Coordinates, 3>> normals; ///< of each slave edge at its nodes
  };
} // namespace taut

#endif
