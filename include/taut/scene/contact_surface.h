// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_surface_h
#define taut_contact_surface_h

#include <taut/base/coordinates.h>

#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /**
   * A part of the boundary of a body in its reference position: nodes, and faces between them.
   *
   * In the plane (dim 2) a face is an edge with 2 nodes, its ends (degree 1), or 3: its ends, then
   * its middle (degree 2). In space (dim 3) it is a quadrilateral with 4 or 9 nodes in the
   * lexicographic order of deal.II's tensor-product support points, or a triangle with 3 nodes or
   * 6: its vertices 0, 1, 2, then the middles of 01, 12 and 20, as FE_SimplexP has them. Faces of
   * both forms may share a surface; its degree is one. A line in space (dim 1) has edges with 2
   * nodes, and a side towards whatever is near.
   *
   * The order of the nodes of a face says nothing about its outer side: @p outward does.
   */
  struct ContactSurface
  {
    std::string name; ///< for messages
    unsigned int dim = 2, degree = 1;
    double thickness = 1.; ///< in the plane and of lines: areas are lengths times this [m]

    /// Positions of the nodes [m]. In the plane z is not read.
    std::vector<Coordinates> points;

    /// Nodes of each face. A node without a face is allowed, and takes no part in contact.
    std::vector<std::vector<unsigned int>> faces;

    /// Hanging nodes, whose displacement is a sum of those of others times weights: they have no
    /// constraint of their own as slaves.
    struct HangingNode
    {
      unsigned int node;
      std::vector<std::pair<unsigned int, double>> parents;
    };
    std::vector<HangingNode> hanging;

    /// Of each face the direction out of the body at its centre, of any length. Only its side of
    /// the face counts, normals themselves are those of the geometry. Obstacles do not read it of
    /// lines.
    std::vector<Coordinates> outward;
  };

  /// Displacement of a node times a vector.
  struct NodeWeight
  {
    unsigned int node = 0; ///< in ContactSurface::points
    Coordinates weight;    ///< [1]
  };

  /**
   * One unilateral constraint of a pair of surfaces, or of a surface and a rigid obstacle:
   *
   *   D = sum over slave (weight . u) + sum over master (weight . u) + gap,   N >= 0, D >= 0, N D =
   * 0.
   *
   * D is a mean gap [m], its multiplier N a force [N] that acts on each node along its weight, so
   * that N > 0 pushes the bodies apart. The contact pressure is N / area [Pa]. Displacements are
   * measured from the reference position.
   */
  struct SurfaceConstraint
  {
    std::vector<NodeWeight> slave;  ///< nodes of the slave surface
    std::vector<NodeWeight> master; ///< nodes of the master surface; none against an obstacle
    double gap = 0.;                ///< D without displacements [m]; negative: penetration
    double area = 0.;               ///< part of the contact surface, positive [m^2]
    Coordinates point;              ///< where on the slave surface it acts, on the average [m]
    Coordinates normal;             ///< unit vector from the slave towards the master
    unsigned int node = 0;          ///< of the slave surface: whose multiplier it is
    double uncovered = 0.; ///< largest part of a slave face at it that lacks a master; 0: none, or
                           ///< all of the face
  };
} // namespace taut

#endif
