// SPDX-License-Identifier: LGPL-2.1-or-later
#include "network.h"
#include "check_parts.h"
#include "kinks.h"

#include <taut/base/exceptions.h>
#include <taut/base/nearest_name.h>
#include <taut/scene/contact_surface.h>
#include <taut/scene/entries.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    bool contains(const std::vector<std::string> &list, const std::string &name)
    {
      return std::find(list.begin(), list.end(), name) != list.end();
    }

    std::size_t wire_index(const Scene &scene, const std::string &name, const std::string &title)
    {
      const std::size_t index = find_name(scene.wires, name);
      if (index == ground)
      {
        std::vector<std::string> known;
        for (const Wire &wire : scene.wires)
          known.push_back(wire.name);
        throw EntryError(title + "/Wire", "'" + name + "' is not a wire" + suggestion(name, known));
      }
      return index;
    }

    std::size_t mass_index(const Scene &scene, const std::string &name, const std::string &entry)
    {
      const Attachment end = parse_attachments(name, scene, entry).front();
      if (end.kind == Attachment::Kind::wire)
        throw EntryError(entry,
                         "a spring acts between masses; between wires use a link with a stiffness");
      return end.kind == Attachment::Kind::ground ? ground : end.index;
    }
  } // namespace

  namespace
  {
    /// Whether an end is at a body in the plane; the surface of the body says so.
    bool is_in_plane(const Scene &scene, const Attachment &end)
    {
      if (end.kind != Attachment::Kind::body)
        return false;
      const CustomBody &body = scene.bodies[end.index];
      try
      {
        return body.type->surface({body.name, body.origin, scene.gravity}, {}).dim == 2;
      }
      catch (const UserError &) // no surface, or none yet: the body reports the error
      {
        return false;
      }
    }

    /// Joints along each of x, y, z in which an end moves. A body in the plane does not move across
    /// its plane; there the joint holds the other end to the ground.
    void add_ball_joint(const Link &all, Scene &scene)
    {
      const std::pair<const char *, Coordinates> axes[] = {
          {" x", {1., 0., 0.}}, {" y", {0., 1., 0.}}, {" z", {0., 0., 1.}}};
      for (const auto &[name, axis] : axes)
      {
        Link link = all;
        link.name += name;
        link.direction = axis;
        for (Attachment *const end : {&link.from, &link.to})
          if (axis.z != 0. && is_in_plane(scene, *end))
            *end = Attachment();
        if (can_move(scene, link.from, false, axis) || can_move(scene, link.to, false, axis))
          scene.links.push_back(link);
      }
    }

    /// Checks entries of links that turn, and entries that only links that turn may have.
    void check_turns(const Network::LinkItem &item, const Link &link, const bool is_ball_joint,
                     const std::string &title)
    {
      if (!link.turns)
      {
        if (link.unstressed_length > 0.)
          throw EntryError(title + "/Length", "it is of a link that turns; set 'Turns = true', or "
                                              "give the Gap");
        return;
      }
      if (is_ball_joint || link.moving())
        throw EntryError(title + "/Turns", "a " + item.type +
                                               " has no direction from end to end; take a joint, "
                                               "a stop or a dropper");
      if (link.rotational)
        throw EntryError(title + "/Rotational", "a link that turns acts between displacements");
      if (!item.direction.empty())
        throw EntryError(title + "/Direction",
                         "a link that turns has that from end to end; leave it empty");
      if (item.find_length || item.axial_stiffness > 0. || item.mass_per_length > 0.)
        throw EntryError(title + (item.find_length            ? "/Find length"
                                  : item.axial_stiffness > 0. ? "/Axial stiffness"
                                                              : "/Mass per length"),
                         "it is of a dropper whose length is found, along a direction that stays; "
                         "give a link that turns its Length and Stiffness");
      if (link.unstressed_length > 0. && link.gap != 0.)
        throw EntryError(title + "/Gap", "it follows from the Length; leave one of them out");
    }
  } // namespace

  void Network::fill(Scene &scene) const
  {
    add_wires(scene);
    add_masses(scene);
    add_links(scene);
    add_loads(scene);
    add_pulls_of_kinks(scene);
  }

  void Network::add_wires(Scene &scene) const
  {
    for (std::size_t i = 0; i < wires.items.size(); ++i)
    {
      const WireItem &item = wires.items[i];
      const std::string title = wires.title(i);
      Wire wire;
      wire.name = wires.names[i];
      wire.origin = title;
      wire.a = parse_coordinates(item.from, title + "/From");
      wire.b = parse_coordinates(item.to, title + "/To");
      // Links need its direction before the whole scene is checked.
      if (!(wire.length() > 0.))
        throw EntryError(title + "/To", "its two ends are at one place; give it a length");
      wire.mass_per_length = item.mass_per_length;
      wire.has_axial = contains(item.components, "bar");
      wire.axial_stiffness = item.axial_stiffness;
      if (contains(item.components, "string") && contains(item.components, "beam"))
        throw EntryError(title + "/Components", "'string' and 'beam' exclude each other");
      if (contains(item.components, "string"))
        wire.transverse = TransverseKind::string;
      if (contains(item.components, "beam"))
        wire.transverse = TransverseKind::beam;
      wire.has_lateral = contains(item.components, "lateral");
      wire.tension = item.tension;
      wire.bending_stiffness = item.bending_stiffness;
      wire.degree = item.degree;
      wire.mass_matrix = item.mass_matrix == "lumped"    ? MassMatrix::lumped
                         : item.mass_matrix == "reduced" ? MassMatrix::reduced
                                                         : MassMatrix::consistent;
      wire.element_size = item.element_size;
      wire.damping = {item.mass_damping, item.stiffness_damping};
      wire.weight = item.weight;
      const auto start =
          [&](const WireMotion motion, const std::string &displacement, const std::string &velocity)
      {
        const std::string entry = title + "/Initial " + component_name(motion);
        return InitialMotion{
            Expression(displacement, entry + " displacement", Expression::Variables::position),
            Expression(velocity, entry + " velocity", Expression::Variables::position)};
      };
      wire.axial_start = start(WireMotion::axial, item.axial_displacement, item.axial_velocity);
      wire.transverse_start =
          start(WireMotion::transverse, item.transverse_displacement, item.transverse_velocity);
      wire.lateral_start =
          start(WireMotion::lateral, item.lateral_displacement, item.lateral_velocity);
      scene.wires.push_back(wire);
    }
    for (std::size_t i = 0; i < supports.items.size(); ++i)
    {
      const SupportItem &item = supports.items[i];
      const std::string title = supports.title(i);
      Support support;
      support.name = supports.names[i];
      support.origin = title;
      support.wire = wire_index(scene, item.wire, title);
      support.positions = parse_positions(item.positions, title + "/Positions");
      support.motion = item.motion == "axial"           ? WireMotion::axial
                       : item.motion == "slope"         ? WireMotion::slope
                       : item.motion == "lateral"       ? WireMotion::lateral
                       : item.motion == "lateral slope" ? WireMotion::lateral_slope
                                                        : WireMotion::transverse;
      support.fixed = item.kind == "fixed";
      support.prescribed =
          Expression(item.displacement, title + "/Displacement", Expression::Variables::time);
      support.stiffness = item.stiffness;
      support.damping = item.damping;
      scene.supports.push_back(support);
    }
    for (std::size_t i = 0; i < point_masses.items.size(); ++i)
    {
      const PointMassItem &item = point_masses.items[i];
      const std::string title = point_masses.title(i);
      PointMass mass;
      mass.name = point_masses.names[i];
      mass.origin = title;
      mass.wire = wire_index(scene, item.wire, title);
      mass.positions = parse_positions(item.positions, title + "/Positions");
      mass.mass = item.mass;
      mass.weight = item.weight;
      scene.point_masses.push_back(mass);
    }
  }

  void Network::add_masses(Scene &scene) const
  {
    for (std::size_t i = 0; i < masses.items.size(); ++i)
    {
      const MassItem &item = masses.items[i];
      Mass mass;
      mass.name = masses.names[i];
      mass.origin = masses.title(i);
      if (find_name(scene.wires, mass.name) != ground || mass.name == "ground")
        throw EntryError(masses.title(i), "the name is taken by a wire or by the ground");
      mass.position = parse_coordinates(item.position, masses.title(i) + "/Position");
      mass.mass = item.mass;
      mass.inertia = item.inertia;
      mass.weight = item.weight;
      const char *motions[4] = {"x", "y", "rotation", "z"};
      for (int k = 0; k < 4; ++k)
        mass.moves[k] = contains(item.motions, motions[k]);
      std::copy(item.displacement.begin(), item.displacement.end(), mass.displacement);
      std::copy(item.velocity.begin(), item.velocity.end(), mass.velocity);
      scene.masses.push_back(mass);
    }
    for (std::size_t i = 0; i < springs.items.size(); ++i)
    {
      const SpringItem &item = springs.items[i];
      const std::string title = springs.title(i);
      Spring spring;
      spring.name = springs.names[i];
      spring.origin = title;
      spring.from = mass_index(scene, item.from, title + "/From");
      spring.to = mass_index(scene, item.to, title + "/To");
      if (spring.from == spring.to)
        throw EntryError(title, "both ends are '" + item.from + "'");
      spring.rotational = item.rotational;
      spring.direction = parse_direction_or_axis(item.rotational, item.direction, {}, title);
      spring.stiffness = item.stiffness;
      spring.damping = item.damping;
      scene.springs.push_back(spring);
    }
  }

  namespace
  {
    /// Throws EntryError for ends on bodies between which no link is possible.
    void check_ends(const Link &link, const Scene &scene, const std::string &title,
                    const bool has_direction)
    {
      if (link.from.kind == Attachment::Kind::body && link.to.kind == link.from.kind &&
          link.from.index == link.to.index && link.from.place == link.to.place)
        throw EntryError(title + "/To",
                         "it is the place that From is; a link is between two places");
      if (!has_direction && !link.rotational &&
          (is_on_cable(scene, link.from) || is_on_cable(scene, link.to)))
        throw EntryError(title + "/Direction",
                         "give 'x, y' or 'x, y, z', or set 'Turns = true': places on a cable are "
                         "counted along it, so that no straight line between the ends is known "
                         "before its shape");
    }
  } // namespace

  void Network::add_links(Scene &scene) const
  {
    for (std::size_t i = 0; i < links.items.size(); ++i)
    {
      const LinkItem &item = links.items[i];
      const std::string title = links.title(i);
      Link link;
      link.origin = title;
      link.kind = item.type == "stop"              ? LinkKind::stop
                  : item.type == "dropper"         ? LinkKind::dropper
                  : item.type == "sliding contact" ? LinkKind::sliding_contact
                                                   : LinkKind::joint;
      const bool is_ball_joint = item.type == "ball joint";
      if (is_ball_joint &&
          (!item.direction.empty() || !item.axis.empty() || item.rotational || item.gap != 0.))
        throw EntryError(title + (!item.direction.empty() ? "/Direction"
                                  : !item.axis.empty()    ? "/Axis"
                                  : item.rotational       ? "/Rotational"
                                                          : "/Gap"),
                         "a ball joint holds one place to another along x, y and z, and has none; "
                         "leave it out, or take a joint");
      link.rotational = item.rotational;
      link.stiffness = parse_stiffness(item.stiffness, title + "/Stiffness");
      link.law = parse_law(item.law, item.law_points, item.law_formula, item.law_range, title);
      if (link.law && (link.unilateral() ? !link.rigid() || item.axial_stiffness > 0. : true))
        throw EntryError(title + "/Law",
                         link.unilateral()
                             ? "it is the law of the force; leave Stiffness 'rigid' and Axial "
                               "stiffness 0"
                             : "a law is for links that only push or pull; give a joint a "
                               "Stiffness");
      if (link.law)
        link.stiffness = link.law->largest_stiffness();
      link.damping = item.damping;
      link.gap = item.gap;
      link.turns = item.turns;
      link.unstressed_length = item.length;
      check_turns(item, link, is_ball_joint, title);
      link.speed = item.speed;
      link.straight = item.straight;
      link.profile =
          Expression(item.profile, title + "/Height profile", Expression::Variables::position);
      link.find_length = item.find_length;
      link.prescribed_displacement = item.prescribed_displacement;
      link.axial_stiffness = item.axial_stiffness;
      link.mass_per_length = item.mass_per_length;
      const auto from = parse_attachments(item.from, scene, title + "/From");
      const auto to = parse_attachments(item.to, scene, title + "/To");
      if (from.size() != to.size() && from.size() != 1 && to.size() != 1)
        throw EntryError(title, "From has " + std::to_string(from.size()) + " positions and To " +
                                    std::to_string(to.size()) +
                                    "; give equal numbers, or one of one");
      const std::size_t n = std::max(from.size(), to.size());
      for (std::size_t k = 0; k < n; ++k)
      {
        link.name = links.names[i] + (n > 1 ? " " + std::to_string(k + 1) : "");
        link.from = from[from.size() > 1 ? k : 0];
        link.to = to[to.size() > 1 ? k : 0];
        if (link.moving() && link.to.kind == Attachment::Kind::body)
          link.to.position = link.to.place.x;
        if (link.straight && !(link.moving() && is_on_cable(scene, link.to)))
          throw EntryError(title + "/Straight", "it is of a sliding contact on a cable, whose "
                                                "length is not that of its way; set it to false");
        check_ends(link, scene, title, !item.direction.empty() || is_ball_joint || link.turns);
        if (is_ball_joint)
        {
          add_ball_joint(link, scene);
          continue;
        }
        if (item.rotational || !item.axis.empty() || !item.direction.empty())
          link.direction =
              parse_direction_or_axis(item.rotational, item.direction, item.axis, title);
        else if (link.turns)
        {
          for (const auto &[end, entry] : {std::pair(&link.from, "/From"), {&link.to, "/To"}})
            if (end->kind == Attachment::Kind::ground && !end->has_place)
              throw EntryError(title + entry, "a link that turns needs the place of its end at the "
                                              "ground; write 'ground @ x, y, z'");
        }
        else
        {
          if ((link.from.kind == Attachment::Kind::ground && !link.from.has_place) ||
              (link.to.kind == Attachment::Kind::ground && !link.to.has_place))
            throw EntryError(title + "/Direction", "give 'x, y' or 'x, y, z', or a place of the "
                                                   "ground, 'ground @ x, y, z'");
          link.direction =
              unit(place(scene, link.to) - place(scene, link.from), title + "/Direction");
        }
        scene.links.push_back(link);
      }
    }
  }

  void Network::add_loads(Scene &scene) const
  {
    for (std::size_t i = 0; i < loads.items.size(); ++i)
    {
      const LoadItem &item = loads.items[i];
      const std::string title = loads.title(i);
      Load load;
      load.origin = title;
      load.kind = item.type == "distributed" ? Load::Kind::distributed
                  : item.type == "moving"    ? Load::Kind::moving
                                             : Load::Kind::point;
      load.rotational = item.rotational;
      load.direction = parse_direction_or_axis(item.rotational, item.direction, item.axis, title);
      load.speed = item.speed;
      if (load.speed != 0. && load.kind != Load::Kind::moving)
        throw EntryError(title + "/Speed",
                         "a " + item.type + " load stands; set 'Type = moving', or Speed to 0");
      std::string on = item.on;
      if (load.kind == Load::Kind::distributed && on.find('@') == std::string::npos)
        on += " @ 0";
      const std::vector<Attachment> targets = parse_attachments(on, scene, title + "/On");
      const bool has_arc_length =
          targets[0].kind == Attachment::Kind::wire || is_on_cable(scene, targets[0]);
      load.magnitude =
          Expression(item.magnitude, title + "/Magnitude",
                     has_arc_length ? Expression::Variables::both : Expression::Variables::time);
      for (const Attachment &target : targets)
      {
        load.name = loads.names[i];
        load.target = target;
        scene.loads.push_back(load);
      }
    }
  }

  namespace
  {
    const Register<SceneGenerator, Network>
        registration("network", "any named wires, masses, springs, links and loads");
  }
} // namespace taut
