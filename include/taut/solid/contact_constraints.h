// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_constraints_h
#define taut_contact_constraints_h

#include <taut/scene/contact_surface.h>

#include <limits>
#include <vector>

namespace taut
{
  class RigidObstacle;

  /// Search distance: the diagonal of the smaller of the two surfaces' bounding boxes.
  constexpr double automatic_search_distance = 0.;

  /*
   * Contact of surfaces with small sliding. In the plane take mortar_constraints() between two
   * bodies; in space take node_to_face_constraints(). Against a rigid obstacle take
   * obstacle_constraints().
   *
   * Normals, places and areas are those of the reference position. In the plane areas are lengths
   * times the thickness [m]; in space the thickness is not read. Constraints are in the order of
   * the nodes of the slave. Signs are those of SurfaceConstraint: D > 0 is open, N > 0 pushes the
   * bodies apart.
   *
   * All functions throw UserError, with the names of the surfaces, if a surface has no faces or a
   * wrong face (number of nodes, a node that does not exist, no area, no clear outer side). They
   * also throw it if dimensions do not fit, and if nothing faces the other side within the search
   * distance [m]. Between two surfaces an overlap is closed up to half of the thickness of the
   * thinner body, at any search distance; a deeper one is a UserError. A surface may be the whole
   * boundary of a body. Where it is not, WholeBoundaries tell the thickness.
   */

  /// The boundaries of two bodies, which must outlive a call; none: the surfaces are all of them.
  struct WholeBoundaries
  {
    const ContactSurface *slave = nullptr, *master = nullptr;
  };

  /**
   * Constraints between nodes of a surface and a rigid obstacle, in the plane or in space. D is the
   * distance of the node. The area of a node is the integral of its shape function, which is the
   * integral of its dual basis function. N_i = p area_i then are the consistent nodal loads of a
   * uniform pressure p on a plane.
   *
   * On triangles with 6 nodes these integrals vanish at the vertices, and the basis is changed. The
   * function of a vertex gets 1/5 of the functions of the adjacent middles, and a middle keeps 3/5
   * of its function. All areas are then positive, loads of a uniform pressure remain consistent,
   * and D of a middle m between vertices a, b is (5 D_m - D_a - D_b) / 3: A. Popp, B. I. Wohlmuth,
   * M. W. Gee, W. A. Wall, SIAM J. Sci. Comput. 34 (2012).
   *
   * A node gets a constraint if it is within the search distance and one of its faces faces the
   * obstacle. A face counts if its cosine to the obstacle is at least half of the largest cosine:
   * the sides of a block that stands on its bottom do not count.
   */
  std::vector<SurfaceConstraint>
  obstacle_constraints(const ContactSurface &surface, const RigidObstacle &obstacle,
                       double thickness = 1.,
                       double search_distance = std::numeric_limits<double>::infinity());

  /**
   * Segment-based mortar constraints with dual Lagrange multipliers between two surfaces in the
   * plane, of degrees 1 or 2 each. The pressure is sum psi_i N_i / area_i along the normal of the
   * slave faces. It acts on the part of the slave surface that the master covers, seen along the
   * averaged nodal normals of the slave. D_i is the mean of the gap with weight psi_i.
   *
   * On a face the psi_i are biorthogonal, over the covered part, to the Lagrange polynomials on the
   * hull of this part. On a completely covered face they are the dual basis of the shape functions,
   * and D_i is the gap at node i. On a partly covered face D_i of the outer node is the gap at the
   * end of the overlap. The sum of the psi_i is 1, so that N_i = p area_i are the consistent nodal
   * loads of a uniform pressure on both bodies. Areas are positive for any overlap.
   *
   * If less than a tenth of a face is covered, two nodes may share one constraint, with the sum of
   * their psi_i. They do so if one node has less than a tenth of the area of the other, or if their
   * constraints differ by less than 0.1 in all weights. A node without an adjacent overlap has no
   * constraint.
   *
   * Dual basis: B. I. Wohlmuth, SIAM J. Numer. Anal. 38 (2000). Segments: M. A. Puso, T. A.
   * Laursen, Comput. Methods Appl. Mech. Engrg. 193 (2004); A. Popp, M. W. Gee, W. A. Wall, Int. J.
   * Numer. Meth. Engng 79 (2009). Faces covered in part: T. Cichosz, M. Bischoff, Comput. Methods
   * Appl. Mech. Engrg. 200 (2011). See also doc/theory_of_contact.md, Contact surfaces.
   */
  std::vector<SurfaceConstraint>
  mortar_constraints(const ContactSurface &slave, const ContactSurface &master,
                     double thickness = 1., double search_distance = automatic_search_distance,
                     const WholeBoundaries &boundaries = {});

  /**
   * Constraints between nodes of the slave and their closest points on the master, in the plane.
   * The area of a node is the integral of its shape function. The method fails the patch test,
   * which mortar_constraints() passes: on non-matching meshes nodal loads of a uniform pressure are
   * wrong by as much as the load of an edge, however fine the meshes are.
   */
  std::vector<SurfaceConstraint> node_to_segment_constraints(
      const ContactSurface &slave, const ContactSurface &master, double thickness = 1.,
      double search_distance = automatic_search_distance, const WholeBoundaries &boundaries = {});

  /// Constraints between nodes of the slave and their closest points on the master, in space, with
  /// areas as in obstacle_constraints(). The method fails the patch test, too.
  std::vector<SurfaceConstraint>
  node_to_face_constraints(const ContactSurface &slave, const ContactSurface &master,
                           double search_distance = automatic_search_distance,
                           const WholeBoundaries &boundaries = {});

  /// A place inside a face of the slave that the other side may enter between its nodes.
  struct InnerPoint
  {
    SurfaceConstraint constraint; ///< of the place; without an area
    double face = 0.;             ///< length of the face [m]
    double needed_face = 0.;      ///< at most, for the nodes to see the other side [m]
  };

  /// For each face of a surface or line where an obstacle stands out between the nodes, the place
  /// where it does so most, to 1/32 of the face, in space 1/8.
  std::vector<InnerPoint>
  obstacle_inner_points(const ContactSurface &surface, const RigidObstacle &obstacle,
                        double search_distance = std::numeric_limits<double>::infinity());

  /// The nodes of the master that are on faces of the slave, and not at their nodes.
  std::vector<InnerPoint> inner_points(const ContactSurface &slave, const ContactSurface &master,
                                       double search_distance = automatic_search_distance,
                                       const WholeBoundaries &boundaries = {});

  /// For each node of a surface in the plane or in space, how far straight edges of its faces are
  /// off the curve that they are chords of, at most [m]. Mean normals at the ends of an edge tell
  /// the curve. Edges of degree 2 that follow the curve, and corners of 0.5 rad and more, do not
  /// count.
  std::vector<double> heights_of_arcs(const ContactSurface &surface);
} // namespace taut

#endif
