// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/network.h"
#include "scene/kinks.h"

#include "base/nearest_name.h"
#include "base/text.h"
#include "scene/entries.h"
#include "scene/travel.h"
#include <taut/base/exceptions.h>

#include <algorithm>

namespace taut
{
  namespace
  {
    bool contains(const std::vector<std::string> &list, const std::string &name)
    {
      return std::find(list.begin(), list.end(), name) != list.end();
    }

    /// From "from, to, change; from, to, change".
    std::vector<TensionChange> tension_changes(const std::string &text, const std::string &entry)
    {
      std::vector<TensionChange> result;
      for (const std::string &part : split(text, ';'))
      {
        const std::vector<double> numbers = parse_positions(part, entry);
        if (numbers.size() != 3)
          throw EntryError(entry, "'" + part +
                                      "': give three numbers, 'from, to, change', and ';' "
                                      "between the parts");
        result.push_back({numbers[0], numbers[1], numbers[2]});
      }
      return result;
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
      if (end.kind == Attachment::Kind::wire || !(end.place == Coordinates()))
        throw EntryError(entry, "a spring acts between the centres of masses; between other places "
                                "use a link with a stiffness");
      return end.kind == Attachment::Kind::ground ? ground : end.index;
    }
  } // namespace

  void Network::fill(Scene &scene) const
  {
    add_wires(scene);
    add_supports(scene);
    add_point_masses(scene);
    add_masses(scene);
    add_springs(scene);
    add_links(scene);
    add_loads(scene);
    add_probes(scene);
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
      wire.remaining = {
          remaining_share(item.remaining_mass, title + "/Remaining mass"),
          remaining_share(item.remaining_axial, title + "/Remaining axial stiffness"),
          remaining_share(item.remaining_bending, title + "/Remaining bending stiffness")};
      wire.degree = item.degree;
      wire.mass_matrix = item.mass_matrix == "lumped"    ? MassMatrix::lumped
                         : item.mass_matrix == "reduced" ? MassMatrix::reduced
                                                         : MassMatrix::consistent;
      wire.element_size = item.element_size;
      wire.damping = {item.mass_damping, item.stiffness_damping};
      wire.foundation_stiffness = item.foundation_stiffness;
      wire.foundation_damping = item.foundation_damping;
      wire.tension_changes = tension_changes(item.tension_changes, title + "/Tension changes");
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
  }

  void Network::add_supports(Scene &scene) const
  {
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
  }

  void Network::add_point_masses(Scene &scene) const
  {
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

  namespace
  {
    void prescribe_motions(const Network::MassItem &item, Mass &mass)
    {
      const Speed speed = parse_speed(item.speed, mass.origin + "/Speed");
      mass.speed = speed.constant;
      mass.travel = speed.travel;
      bool any = false;
      for (int k = 0; k < 4; ++k)
      {
        if (item.prescribed[k].empty())
          continue;
        const std::string entry = std::string("Prescribed ") + motion_names[k];
        mass.prescribed[k] = Expression(item.prescribed[k], mass.origin + "/" + entry);
        mass.moves[k] = mass.is_prescribed[k] = any = true;
      }
      if (moves(mass) && !any)
        throw EntryError(mass.origin + "/Speed",
                         "it moves the place s of prescribed motions, and this mass has none; give "
                         "it one, or set Speed to 0");
    }
  } // namespace

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
      for (int k = 0; k < 4; ++k)
        mass.moves[k] = contains(item.motions, motion_names[k]);
      prescribe_motions(item, mass);
      std::copy(item.displacement.begin(), item.displacement.end(), mass.displacement);
      std::copy(item.velocity.begin(), item.velocity.end(), mass.velocity);
      scene.masses.push_back(mass);
    }
  }

  void Network::add_springs(Scene &scene) const
  {
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
      load.acts_while_built = item.acts_while_built;
      const Speed speed = parse_speed(item.speed, title + "/Speed");
      load.speed = speed.constant;
      load.travel = speed.travel;
      load.faster_than_waves = item.faster_than_waves;
      if (moves(load) && load.kind != Load::Kind::moving)
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

  void Network::add_probes(Scene &scene) const
  {
    for (std::size_t i = 0; i < probes.items.size(); ++i)
      probes.items[i].add(probes.names[i], probes.title(i), scene);
  }

  namespace
  {
    const Register<SceneGenerator, Network>
        registration("network", "any named wires, masses, springs, links and loads");
  }
} // namespace taut
