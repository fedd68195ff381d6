// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_surface_h
#define taut_contact_surface_h

#include <taut/base/coordinates.h>

#include <vector>

namespace taut
{
  /**
   * A part of the boundary of a body in its reference position: nodes, and faces between them.
   *
   * In the plane a face is an edge with 2 nodes (degree 1) or 3 (degree 2: its ends, then its
   * middle). In space it is a quadrilateral with 4 or 9 nodes in lexicographic order, or a triangle
   * with its 3 corners and at degree 2 the middles of its edges.
   */
  struct ContactSurface
  {
    unsigned int dim = 2;
    unsigned int degree = 1;
    std::vector<Coordinates> points;              ///< of the nodes [m]
    std::vector<std::vector<unsigned int>> faces; ///< nodes of each
    std::vector<Coordinates> outward;             ///< unit normal at the centre of each face
  };
} // namespace taut

#endif
