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
   * Return one from BodyType::surface() to give a body contact surfaces.
   *
   * In the plane (dim 2) a face is an edge. It has 2 nodes, its ends (degree 1), or 3 nodes, its
   * ends and then its middle (degree 2). In space (dim 3) a face is a quadrilateral or a triangle.
   * Quadrilaterals have 4 or 9 nodes in the lexicographic order of deal.II's tensor-product support
   * points. Triangles have 3 or 6 nodes: the vertices 0, 1, 2, then the middles of 01, 12 and 20,
   * as in FE_SimplexP. A surface may have faces of both forms, of one degree. A line in space (dim
   * 1) has edges with 2 nodes, and a side towards whatever is near.
   *
   * @p outward gives the outer side of a face; the order of its nodes does not.
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

    /// Hanging nodes: their displacement is a weighted sum of displacements of other nodes. As
    /// slaves they have no constraint of their own.
    struct HangingNode
    {
      unsigned int node;
      std::vector<std::pair<unsigned int, double>> parents;
    };
    std::vector<HangingNode> hanging;

    /// For each face the direction out of the body at the centre of the face, of any length. It
    /// only tells the outer side; normals are those of the geometry. Obstacles do not read it for
    /// lines.
    std::vector<Coordinates> outward;
  };

  /// A term of a SurfaceConstraint: the displacement of a node times a vector.
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
   * D is a mean gap [m]. The Lagrange multiplier N is a force [N] that acts on each node along the
   * weight of the node; N > 0 pushes the bodies apart. The contact pressure is N / area [Pa].
   * Displacements are measured from the reference position.
   */
  struct SurfaceConstraint
  {
    std::vector<NodeWeight> slave;  ///< nodes of the slave surface
    std::vector<NodeWeight> master; ///< nodes of the master surface; none against an obstacle
    double gap = 0.;                ///< D without displacements [m]; negative: penetration
    double area = 0.;               ///< part of the contact surface, positive [m^2]
    Coordinates point;              ///< mean place on the slave surface where the force acts [m]
    Coordinates normal;             ///< unit vector from the slave towards the master
    unsigned int node = 0;          ///< node of the slave surface that N belongs to
    double uncovered = 0.; ///< largest part of a slave face at the node without a master; 0: no
                           ///< part, or the whole face
  };
} // namespace taut

#endif
