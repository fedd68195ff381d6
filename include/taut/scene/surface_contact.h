// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_surface_contact_h
#define taut_surface_contact_h

#include <taut/base/coordinates.h>
#include <taut/scene/expression.h>
#include <taut/scene/named_items.h>

#include <cstddef>
#include <string>
#include <vector>

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
