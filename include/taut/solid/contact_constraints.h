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
   * Constraints of small sliding: normals, places and areas are those of the reference position.
   * In the plane areas are lengths times the thickness [m]; in space a thickness is not read.
   * Constraints are in the order of the slave's nodes. All functions throw UserError, with the
   * names of the surfaces, if a surface has no faces or wrong ones (number of nodes, a node that is
   * not there, no area, an outer side that cannot be told), if dimensions do not fit, and if
   * nothing faces the other side within the search distance [m]. Between two surfaces the search
   * looks back, for penetration, by the size of the larger of the two faces at most: a surface may
   * be the whole boundary of a body. Signs are those of SurfaceConstraint: D > 0 is open, N > 0
   * pushes the bodies apart.
   */

  /**
   * Nodes of a surface against a rigid obstacle, in the plane or in space: D is the distance of
   * the node, the area of a node the integral of its shape function, which is the integral of its
   * dual basis function. N_i = p area_i then are the consistent nodal loads of a uniform pressure
   * p on a plane.
   *
   * On triangles with 6 nodes these integrals vanish at the vertices. There the basis is changed
   * before: the function of a vertex gets 1/5 of those of the middles beside it, and a middle keeps
   * 3/5 of its own. All areas are positive then, loads of a uniform pressure stay consistent, and D
   * of a middle m between vertices a, b is (5 D_m - D_a - D_b) / 3: A. Popp, B. I. Wohlmuth, M. W.
   * Gee, W. A. Wall, SIAM J. Sci. Comput. 34 (2012).
   *
   * Nodes get a constraint if they are within the search distance and one of their faces faces the
   * obstacle. Of their faces those count whose cosine to the obstacle is at least half of the
   * largest: not the sides of a block that stands on its bottom.
   */
  std::vector<SurfaceConstraint>
  obstacle_constraints(const ContactSurface &surface, const RigidObstacle &obstacle,
                       double thickness = 1.,
                       double search_distance = std::numeric_limits<double>::infinity());

  /**
   * Segment-based mortar constraints with dual multipliers between two surfaces in the plane, of
   * degrees 1 or 2 each. The pressure is sum psi_i N_i / area_i along the normal of the slave's
   * faces, on the part of the slave surface that the master covers, seen along the slave's averaged
   * nodal normals, and D_i is the mean of the gap with weight psi_i.
   *
   * On a face the psi_i are biorthogonal over the covered part to the Lagrange polynomials on the
   * hull of this part: on a face that is covered as a whole they are the dual basis of the shape
   * functions, and D_i is the gap at node i; on one covered in part D_i of the outer node is the
   * gap at the end of the overlap. Their sum is 1, so that N_i = p area_i are the consistent nodal
   * loads of a uniform pressure on both bodies, and areas are positive for any overlap.
   *
   * On a face of which less than a tenth is covered, nodes become one, with the sum of their psi_i,
   * if one has less than a tenth of the area of the other, or if their constraints differ by less
   * than 0.1 in all weights. A node without overlap beside it has no constraint.
   *
   * Dual basis: B. I. Wohlmuth, SIAM J. Numer. Anal. 38 (2000). Segments: M. A. Puso, T. A.
   * Laursen, Comput. Methods Appl. Mech. Engrg. 193 (2004); A. Popp, M. W. Gee, W. A. Wall, Int. J.
   * Numer. Meth. Engng 79 (2009). Faces covered in part: T. Cichosz, M. Bischoff, Comput. Methods
   * Appl. Mech. Engrg. 200 (2011). See also doc/theory.md, Contact surfaces.
   */
  std::vector<SurfaceConstraint>
  mortar_constraints(const ContactSurface &slave, const ContactSurface &master,
                     double thickness = 1., double search_distance = automatic_search_distance);

  /**
   * Nodes of the slave against their closest points on the master, in the plane. The area of a node
   * is the integral of its shape function. It fails the patch test: nodal loads of a uniform
   * pressure on non-matching meshes are wrong by as much as those of an edge, however fine the
   * meshes are. mortar_constraints() passes it.
   */
  std::vector<SurfaceConstraint>
  node_to_segment_constraints(const ContactSurface &slave, const ContactSurface &master,
                              double thickness = 1.,
                              double search_distance = automatic_search_distance);

  /// The same in space, with areas as in obstacle_constraints(). It fails the patch test, too.
  std::vector<SurfaceConstraint>
  node_to_face_constraints(const ContactSurface &slave, const ContactSurface &master,
                           double search_distance = automatic_search_distance);

  /// Of each node of a surface in the plane or in space, the largest angle between normals of faces
  /// at a node of its own faces; angles of 0.5 rad and more are corners and do not count [rad].
  std::vector<double> kinks_at_nodes(const ContactSurface &surface);
} // namespace taut

#endif
