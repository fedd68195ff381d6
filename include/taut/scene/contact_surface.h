// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_surface_h
#define taut_contact_surface_h

#include <taut/base/coordinates.h>
#include <taut/scene/expression.h>
#include <taut/scene/named_items.h>

#include <cstddef>
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

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  struct CustomBody;

  /// A rigid obstacle at rest, as entries describe it; see RigidObstacle.
  struct ObstacleSetting
  {
    enum class Shape
    {
      none,
      plane,    ///< the half space behind a plane
      cylinder, ///< about an axis
      sphere,
      height ///< all below a graph over the plane across `direction`
    };
    Shape shape = Shape::none;
    Coordinates point;           ///< of the plane or the axis, or the centre [m]
    Coordinates direction;       ///< out of the plane; of the axis; upwards
    double radius = 0.;          ///< [m]
    bool encloses_body = false;  ///< of a cylinder or sphere: a bore or socket
    Expression height;           ///< formula of x, y, z [m]
    double height_change = 1e-3; ///< step of the differences of the height [m]
  };

  /// How the constraints of two surfaces are made: mortar_constraints(), or
  /// node_to_face_constraints() and its like in the plane.
  enum class SurfaceMethod
  {
    mortar,
    nodes_to_faces
  };

  /// A contact between two parts of boundaries of bodies, or between a part of a boundary and an
  /// obstacle. Sliding is small.
  struct SurfaceContact
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty

    struct Side
    {
      std::size_t body = 0; ///< of the scene
      std::vector<unsigned int> boundaries;
    };
    Side slave, master; ///< the master counts without an obstacle
    ObstacleSetting obstacle;
    SurfaceMethod method = SurfaceMethod::mortar;
    double gap = 0.;             ///< added to the gap of the shapes [m]
    double compliance = 0.;      ///< closing of the gap by a pressure [m/Pa]
    double search_distance = 0.; ///< sides that are farther apart do not touch; 0: automatic [m]
    double largest_sliding = 2.; ///< larger sliding ends the run [elements]
    bool chooses_slave = false;  ///< the sides change places if that avoids an overhang
  };

  /// The contacts of a parameter file: `Contacts` lists them, each has a section `Contact <name>`.
  class ContactParameters
  {
  public:
    void declare_names(dealii::ParameterHandler &prm) { items.declare_names(prm); }
    void declare_parameters(dealii::ParameterHandler &prm) { items.declare_parameters(prm); }

    /// The contacts between these bodies. Throws EntryError.
    std::vector<SurfaceContact> contacts(const std::vector<CustomBody> &bodies) const;

  private:
    struct Item
    {
      void declare(dealii::ParameterHandler &prm);
      ObstacleSetting obstacle_setting(const std::string &section) const;
      std::string slave, master, obstacle = "none", method = "mortar", height = "0";
      std::vector<double> point = {0., 0.}, direction = {0., 1.};
      double radius = 1., gap = 0., compliance = 0., search_distance = 0., height_change = 1e-3,
             largest_sliding = 2.;
      bool encloses_body = false, chooses_slave = false;
    };
    NamedItems<Item> items{"", "Contacts", "Contact",
                           "contacts between boundaries of bodies and obstacles"};
  };
} // namespace taut

#endif
