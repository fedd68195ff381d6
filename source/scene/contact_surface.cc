// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/entries.h"
#include <taut/base/exceptions.h>
#include <taut/scene/body_type.h>
#include <taut/scene/contact_surface.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace taut
{
  namespace
  {
    namespace Patterns = dealii::Patterns;

    /// "block: 2, 3" or "block".
    SurfaceContact::Side side(const std::string &text, const std::vector<CustomBody> &bodies,
                              const std::string &entry)
    {
      const std::size_t colon = text.find(':');
      const std::string name = dealii::Utilities::trim(text.substr(0, colon));
      SurfaceContact::Side result;
      result.body = find_name(bodies, name);
      if (result.body == ground)
      {
        std::string known;
        for (const CustomBody &body : bodies)
          known += (known.empty() ? "" : ", ") + body.name;
        throw EntryError(entry, "'" + name + "' is not the name of a body in 'Bodies'" +
                                    (known.empty() ? "" : "; known are: " + known) +
                                    ". Write 'body: 2' or 'body: 2, 3' with ids of its boundary");
      }
      if (colon == std::string::npos)
        return result;
      try
      {
        for (const int id : dealii::Utilities::string_to_int(
                 dealii::Utilities::split_string_list(text.substr(colon + 1))))
          result.boundaries.push_back(id);
      }
      catch (const std::exception &)
      {
        throw EntryError(entry, "'" + text.substr(colon + 1) +
                                    "' is not a list of ids of the boundary, as in 'body: 2, 3'");
      }
      return result;
    }

    bool overlap(const SurfaceContact::Side &a, const SurfaceContact::Side &b)
    {
      return a.body == b.body &&
             (a.boundaries.empty() || b.boundaries.empty() ||
              std::find_first_of(a.boundaries.begin(), a.boundaries.end(), b.boundaries.begin(),
                                 b.boundaries.end()) != a.boundaries.end());
    }

    bool are_same(const ObstacleSetting &a, const ObstacleSetting &b)
    {
      return a.shape == b.shape && a.point == b.point && a.direction == b.direction &&
             a.radius == b.radius && a.encloses_body == b.encloses_body &&
             a.height.formula() == b.height.formula();
    }

    /// Whether nodes would have two constraints for one contact, which would share its force.
    bool have_same_sides(const SurfaceContact &a, const SurfaceContact &b)
    {
      if (a.obstacle.shape != ObstacleSetting::Shape::none ||
          b.obstacle.shape != ObstacleSetting::Shape::none)
        return are_same(a.obstacle, b.obstacle) && overlap(a.slave, b.slave);
      return (overlap(a.slave, b.slave) && overlap(a.master, b.master)) ||
             (overlap(a.slave, b.master) && overlap(a.master, b.slave));
    }
  } // namespace

  void ContactParameters::Item::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Slave", slave,
                      "A body and ids of its boundary, 'body: 2' or 'body: 2, 3'; without ids all "
                      "of it. Its nodes have the contact forces",
                      Patterns::Anything());
    prm.add_parameter("Master", master, "The same of the other side, without an obstacle",
                      Patterns::Anything());
    prm.add_parameter("Method", method,
                      "Between two bodies: mortar, with dual multipliers, in the plane; or nodes "
                      "to faces, which does not pass the patch test",
                      Patterns::Selection("mortar|nodes to faces"));
    prm.add_parameter("Obstacle", obstacle,
                      "Rigid, instead of a master: plane, cylinder, sphere, or height, which is "
                      "all below a graph",
                      Patterns::Selection("none|plane|cylinder|sphere|height"));
    prm.add_parameter(
        "Point", point,
        "Of the obstacle: on the plane or the axis, or the centre; 'x, y' or 'x, y, z' [m]",
        Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter("Direction", direction,
                      "Of the obstacle: out of the plane; of the axis, '0, 0, 1' in the plane; "
                      "upwards over the graph",
                      Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter("Radius", radius, "Of a cylinder or sphere [m]", Patterns::Double(0.));
    prm.add_parameter("Encloses body", encloses_body,
                      "The cylinder or sphere is a bore or a socket, and the body inside");
    prm.add_parameter("Height", height,
                      "Of the graph along Direction above the origin, a formula of x, y, z [m]");
    prm.add_parameter("Height difference", height_change,
                      "Step of the differences that make the slope of the graph [m]",
                      Patterns::Double(0.));
    prm.add_parameter("Gap", gap, "Added to the distance of the surfaces [m]");
    prm.add_parameter("Compliance", compliance,
                      "How far a pressure brings the surfaces into each other; 0: rigid [m/Pa]",
                      Patterns::Double(0.));
    prm.add_parameter("Search distance", search_distance,
                      "Sides farther apart than this do not touch; 0: automatic, the diagonal of "
                      "the smaller side [m]",
                      Patterns::Double(0.));
    prm.add_parameter("Choose slave", chooses_slave,
                      "Slave and master of a mortar contact change places if the slave overhangs "
                      "the master at fewer faces then");
    prm.add_parameter("Largest sliding", largest_sliding,
                      "A run ends when a closed contact slides by more of its elements: forces act "
                      "where the undeformed surfaces meet. It is warned of from 0.5 on; a plane as "
                      "the obstacle has no limit [1]",
                      Patterns::Double(0.));
  }

  /// The obstacle of the item with its shape. Throws EntryError.
  ObstacleSetting ContactParameters::Item::obstacle_setting(const std::string &section) const
  {
    using Shape = ObstacleSetting::Shape;
    ObstacleSetting result;
    result.shape = obstacle == "plane"      ? Shape::plane
                   : obstacle == "cylinder" ? Shape::cylinder
                   : obstacle == "sphere"   ? Shape::sphere
                   : obstacle == "height"   ? Shape::height
                                            : Shape::none;
    const bool is_round = result.shape == Shape::cylinder || result.shape == Shape::sphere;
    result.point = parse_coordinates(point, section + "Point");
    result.direction = parse_direction(direction, section + "Direction");
    result.radius = radius;
    if (is_round && !(radius > 0.))
      throw EntryError(section + "Radius", "it must be positive");
    if (encloses_body && !is_round)
      throw EntryError(section + "Encloses body",
                       "only a cylinder or a sphere encloses a body; set it to false, and "
                       "Direction to the side that is free");
    result.encloses_body = encloses_body;
    result.height = Expression(height, section + "Height", Expression::Variables::space);
    if (result.height.depends_on_time())
      throw EntryError(section + "Height", "an obstacle does not move: no t in its formula");
    if (!(height_change > 0.))
      throw EntryError(section + "Height difference", "it must be positive");
    result.height_change = height_change;
    return result;
  }

  std::vector<SurfaceContact>
  ContactParameters::contacts(const std::vector<CustomBody> &bodies) const
  {
    std::vector<SurfaceContact> result;
    for (std::size_t i = 0; i < items.items.size(); ++i)
    {
      const Item &item = items.items[i];
      SurfaceContact contact;
      contact.name = items.names[i];
      contact.origin = items.title(i);
      const std::string section = contact.origin + "/";
      contact.slave = side(item.slave, bodies, section + "Slave");
      const bool has_obstacle = item.obstacle != "none";
      if (!has_obstacle && item.master.empty())
        throw EntryError(contact.origin, "give it a Master or an Obstacle");
      if (!has_obstacle)
        contact.master = side(item.master, bodies, section + "Master");
      else if (!item.master.empty())
        throw EntryError(section + "Master", "a contact has a master or an obstacle, not both; "
                                             "leave it empty or set Obstacle = none");
      contact.obstacle = item.obstacle_setting(section);
      contact.method =
          item.method == "mortar" ? SurfaceMethod::mortar : SurfaceMethod::nodes_to_faces;
      contact.gap = item.gap;
      contact.compliance = item.compliance;
      contact.search_distance = item.search_distance;
      contact.largest_sliding = item.largest_sliding;
      contact.chooses_slave = item.chooses_slave;
      if (item.chooses_slave && (has_obstacle || contact.method != SurfaceMethod::mortar))
        throw EntryError(section + "Choose slave",
                         "only sides of a mortar contact change places; set it to false");
      for (const SurfaceContact &other : result)
        if (have_same_sides(other, contact))
          throw EntryError(
              contact.origin,
              "'" + other.origin +
                  "' has the same two sides; remove one, or boundaries that both name");
      result.push_back(std::move(contact));
    }
    return result;
  }
} // namespace taut
