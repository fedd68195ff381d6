// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/check_parts.h"

#include "scene/travel.h"
#include "scene/wave_speed.h"
#include <taut/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

namespace taut
{
  bool can_move(const Scene &scene, const Attachment &end, const bool rotational,
                const Coordinates &direction)
  {
    constexpr double tiny = 1e-12;
    constexpr std::array<WireMotion, 2> slopes = {WireMotion::slope, WireMotion::lateral_slope};
    const auto along = [&](const Coordinates &p) { return std::fabs(dot(direction, p)) > tiny; };
    if (end.kind == Attachment::Kind::ground)
      return false;
    if (end.kind == Attachment::Kind::body)
      return !rotational; // only the body knows which of its points move
    if (end.kind == Attachment::Kind::mass)
    {
      const Mass &mass = scene.masses[end.index];
      const bool turns_under_arm =
          mass.moves[2] &&
          std::fabs(end.place.x * direction.y - end.place.y * direction.x) > tiny * norm(end.place);
      return rotational
                 ? mass.moves[2] && along({0., 0., 1.})
                 : turns_under_arm || (mass.moves[0] && along({1., 0.})) ||
                       (mass.moves[1] && along({0., 1.})) || (mass.moves[3] && along({0., 0., 1.}));
    }
    const Wire &wire = scene.wires[end.index];
    if (rotational)
      return std::any_of(slopes.begin(), slopes.end(),
                         [&](const WireMotion slope)
                         { return wire.has(slope) && along(wire.rotation_axis(slope)); });
    return std::any_of(std::begin(wire_components), std::end(wire_components),
                       [&](const WireMotion motion)
                       { return wire.has(motion) && along(wire.axis(motion)); });
  }

  namespace
  {
    void check_wire(const Wire &wire)
    {
      const std::string what = "wire '" + wire.name + "': ";
      const double length = wire.length();
      if (!(length > 0.))
        fail(wire, "To", what, "its two ends are at one place; give it a length");
      constexpr double longest = 1e12;
      if (!(length <= longest))
        fail(wire, "To", what, "it is ", length, " m long; at most ", longest, " m are possible");
      if (!wire.has_axial && wire.transverse == TransverseKind::none)
        fail(wire, "Components", what, "it has none; name at least one of bar, string, beam");
      if (wire.has_lateral && wire.transverse == TransverseKind::none)
        fail(wire, "Components", what,
             "'lateral' is a string's or a beam's second motion across it; add one of them");
      if (!(wire.mass_per_length > 0.))
        fail(wire, "Mass per length", what, "it must be positive");
      if (!(wire.element_size > 0.))
        fail(wire, "Element size", what, "it must be positive");
      constexpr double most_elements = 2e7;
      if (!(length / wire.element_size <= most_elements))
        fail(wire, "Element size", what, length / wire.element_size,
             " elements are too many; make them larger");
      // Nodes are places in space, and have to be distinct there.
      constexpr double least_ratio = 1e-10;
      double farthest = 0.;
      for (const Coordinates &end : {wire.a, wire.b})
        for (unsigned int i = 0; i < 3; ++i)
          farthest = std::max(farthest, std::fabs(end[i]));
      if (!(std::min(length, wire.element_size) >= least_ratio * farthest))
        fail(wire, "From", what, "it is ", farthest,
             " m from the origin, so far that its elements of ",
             std::min(length, wire.element_size),
             " m are lost in rounding; put the origin beside it");
      for (const TensionChange &c : wire.tension_changes)
        if (!(c.from >= 0. && c.from < c.to && c.to <= length * (1. + 1e-12)) ||
            !(wire.tension + c.change > 0.))
          fail(wire, "Tension changes", what, "from ", c.from, " to ", c.to, " m by ", c.change,
               " N: the part has to be inside the wire, 0 to ", length,
               " m, and its tension positive");
      if (wire.has_axial && !(wire.axial_stiffness > 0.))
        fail(wire, "Axial stiffness", what, "a bar needs a positive one");
      if (wire.transverse == TransverseKind::string && !(wire.tension > 0.))
        fail(wire, "Tension", what, "a string needs a positive one");
      if (wire.transverse == TransverseKind::beam && !(wire.bending_stiffness > 0.))
        fail(wire, "Bending stiffness", what,
             "a beam needs a positive one; without one the wire is a string");
    }

    template <typename Item>
    void check_position(const Scene &scene, const std::size_t wire, const double s,
                        const Item &item, const std::string &entry, const std::string &what)
    {
      const double length = scene.wires[wire].length();
      if (!(s >= 0. && s <= length * (1. + 1e-12)))
        fail(item, entry, what, "position ", s, " m is outside wire '", scene.wires[wire].name,
             "', 0 to ", length, " m");
    }

    template <typename Item>
    void check_attachment(const Scene &scene, const Attachment &end, const bool rotational,
                          const Item &item, const std::string &entry, const std::string &what)
    {
      if (end.kind == Attachment::Kind::ground)
        return;
      if (end.kind == Attachment::Kind::mass)
      {
        if (!(end.place == Coordinates()) && !scene.masses[end.index].moves[2])
          fail(item, entry, what, "a place beside the centre of mass '",
               scene.masses[end.index].name,
               "' is for a mass that rotates; add 'rotation' to its Motions");
        if (rotational && !scene.masses[end.index].moves[2])
          fail(item, entry, what, "mass '", scene.masses[end.index].name,
               "' does not rotate; add 'rotation' to its Motions");
        return;
      }
      if (end.kind == Attachment::Kind::body)
      {
        if (rotational)
          fail(item, entry, what, "body '", scene.bodies[end.index].name,
               "' has no rotation at a point; act on displacements instead");
        return;
      }
      check_position(scene, end.index, end.position, item, entry, what);
      if (rotational && scene.wires[end.index].transverse != TransverseKind::beam)
        fail(item, entry, what, "wire '", scene.wires[end.index].name,
             "' has no slope to hold; a moment or an angular gap needs the component beam");
    }

    /// A motion of a point can be held only once.
    void check_held_once(const Scene &scene)
    {
      struct Held
      {
        std::size_t wire;
        WireMotion motion;
        double s;
        const Support *support;
      };
      std::vector<Held> held;
      for (const Support &support : scene.supports)
        if (support.fixed)
          for (const double s : support.positions)
            held.push_back({support.wire, support.motion, s, &support});
      std::sort(held.begin(), held.end(),
                [](const Held &p, const Held &q)
                {
                  return std::tie(p.wire, p.motion, p.s, p.support) <
                         std::tie(q.wire, q.motion, q.s, q.support);
                });
      for (std::size_t i = 1; i < held.size(); ++i)
      {
        const Held &p = held[i - 1], &q = held[i];
        const Wire &wire = scene.wires[q.wire];
        if (p.wire == q.wire && p.motion == q.motion && q.s - p.s <= 1e-12 * wire.length())
          fail(*q.support, "Positions", "support '", q.support->name, "': wire '", wire.name,
               "' is held there already, at ", p.s, " m by support '", p.support->name,
               "'; two supports cannot hold the same motion of the same point, remove one");
      }
    }

    void check_supports(const Scene &scene)
    {
      for (const Support &support : scene.supports)
      {
        const Wire &wire = scene.wires[support.wire];
        const std::string what = "support '" + support.name + "': ";
        if (support.positions.empty())
          fail(support, "Positions", what, "it has no position");
        for (const double s : support.positions)
          check_position(scene, support.wire, s, support, "Positions", what);
        if (support.motion == WireMotion::axial && !wire.has_axial)
          fail(support, "Motion", what, "wire '", wire.name,
               "' has no component bar to hold along it");
        if (support.motion == WireMotion::transverse && wire.transverse == TransverseKind::none)
          fail(support, "Motion", what, "wire '", wire.name,
               "' has no component string or beam to hold across it");
        if (component_of(support.motion) == WireMotion::lateral && !wire.has_lateral)
          fail(support, "Motion", what, "wire '", wire.name,
               "' has no component lateral to hold across it");
        if (is_slope(support.motion) && wire.transverse != TransverseKind::beam)
          fail(support, "Motion", what, "wire '", wire.name,
               "' has no slope; only the component beam has");
        if (!support.fixed && support.stiffness == 0. && support.damping == 0.)
          fail(support, "Stiffness", what, "an elastic support needs a Stiffness or a Damping");
        if (!support.fixed && support.prescribed.depends_on_time())
          fail(
              support, "Displacement", what,
              "the spring of an elastic support is free of force at one place: give a number; what "
              "moves is a fixed support, or a mass with a Prescribed motion and a link");
      }
      check_held_once(scene);
      for (const PointMass &mass : scene.point_masses)
      {
        const std::string what = "point mass '" + mass.name + "': ";
        if (mass.positions.empty())
          fail(mass, "Positions", what, "it has no position");
        for (const double s : mass.positions)
          check_position(scene, mass.wire, s, mass, "Positions", what);
      }
    }

    void check_masses(const Scene &scene)
    {
      for (const Mass &mass : scene.masses)
        if (mass.inertia > 0. && !mass.moves[2])
          fail(mass, "Inertia", "mass '", mass.name,
               "': it has one but 'rotation' is not among its Motions");
      for (const Spring &spring : scene.springs)
      {
        const std::string what = "spring '" + spring.name + "': ";
        for (const std::size_t end : {spring.from, spring.to})
          if (end != ground)
          {
            const Mass &mass = scene.masses[end];
            const bool moves = spring.rotational ? mass.moves[2] && spring.direction.z != 0.
                                                 : ((mass.moves[0] && spring.direction.x != 0.) ||
                                                    (mass.moves[1] && spring.direction.y != 0.) ||
                                                    (mass.moves[3] && spring.direction.z != 0.));
            if (!moves)
              fail(spring, "Direction", what, "mass '", mass.name,
                   "' cannot move in the direction of the spring");
          }
        if (spring.stiffness == 0. && spring.damping == 0.)
          fail(spring, "Stiffness", what, "it has neither Stiffness nor Damping");
      }
    }

    /// Whether an end of a link can move: along the direction of the link or, if the link turns, at
    /// all.
    bool can_move(const Scene &scene, const Link &link, const Attachment &end)
    {
      if (!link.turns)
        return can_move(scene, end, link.rotational, link.direction);
      return can_move(scene, end, false, {1., 0., 0.}) || can_move(scene, end, false, {0., 1.}) ||
             can_move(scene, end, false, {0., 0., 1.});
    }

    /// Fixed links that act on the same two points would have no effect at all.
    bool same_point(const Attachment &a, const Attachment &b)
    {
      return a.kind == b.kind &&
             (a.kind == Attachment::Kind::ground ||
              (a.index == b.index && a.position == b.position && a.place == b.place));
    }

    /// Two links of one section between the same points along the same direction come from a
    /// position that was written twice.
    void check_repeated(const Scene &scene)
    {
      const auto key = [](const Link &link)
      {
        const auto end = [](const Attachment &a)
        { return std::make_tuple(a.kind, a.index, a.position, a.place.x, a.place.y, a.place.z); };
        const Coordinates &n = link.direction;
        std::vector<decltype(end(link.from))> rings;
        for (const Attachment &ring : link.through)
          rings.push_back(end(ring));
        return std::make_tuple(link.origin, end(link.from), end(link.to), rings, n.x, n.y, n.z);
      };
      std::set<decltype(key(scene.links[0]))> known;
      for (const Link &link : scene.links)
        if (!link.origin.empty() && !link.moving() && !known.insert(key(link)).second)
          fail(link, "To", "link '", link.name,
               "': the one before it is between the same two points; remove one of the positions");
    }

    void check_pull(const Link &link, const std::string &what)
    {
      if (!link.form.find_length)
        fail(link, "Pull", what,
             "the length of the rope follows from it; set 'Find length = true'");
      if (link.law)
        fail(link, "Law", what, "a rope with a Pull has a Stiffness or an Axial stiffness");
      if (link.form.prescribed_displacement != 0.)
        fail(link, "Prescribed displacement", what,
             "the length follows from the Pull or from the height; leave one of them out");
    }

    void check_rings(const Scene &scene, const Link &link, const std::string &what)
    {
      if (link.through.empty())
        return;
      if (!link.turns || link.kind != LinkKind::dropper)
        fail(link, "Through", what,
             "it is of a rope, which only pulls; take a dropper with 'Turns = true'");
      for (const Attachment &ring : link.through)
      {
        check_attachment(scene, ring, false, link, "Through", what);
        if (ring.kind == Attachment::Kind::ground && !ring.has_place)
          fail(link, "Through", what,
               "a ring at the ground needs a place; write 'ground @ x, y, z'");
      }
    }

    void check_links(const Scene &scene, const double end_time)
    {
      check_repeated(scene);
      check_strips(scene, end_time);
      for (const Link &link : scene.links)
      {
        const std::string what = "link '" + link.name + "': ";
        check_attachment(scene, link.from, link.rotational, link, "From", what);
        if (link.strip.empty())
          check_attachment(scene, link.to, link.rotational, link, "To", what);
        check_rings(scene, link, what);
        if (!link.any_place([](const Attachment &at)
                            { return at.kind != Attachment::Kind::ground; }))
          fail(link, "To", what, "both ends are the ground");
        if (!link.moving() && link.through.empty() && same_point(link.from, link.to))
          fail(link, "To", what, "both ends are the same point; a link acts between two");
        if (!link.any_place([&](const Attachment &at) { return can_move(scene, link, at); }))
          fail(link, link.rotational ? "Axis" : "Direction", what, "neither end can ",
               link.rotational ? "turn about" : "move along",
               " it; add motions or components, or change it");
        if (link.damping > 0. && link.rigid())
          fail(link, "Damping", what, "a rigid link has none; give it a finite Stiffness");
        if (link.form.find_length &&
            (link.kind != LinkKind::dropper || link.from.kind == Attachment::Kind::ground ||
             link.to.kind == Attachment::Kind::ground))
          fail(link, "Find length", what, "it is for a dropper between two bodies");
        if (link.form.pull > 0.)
          check_pull(link, what);
        if (link.form.find_length && link.form.mass_per_length > 0. &&
            (link.from.kind == Attachment::Kind::body || link.to.kind == Attachment::Kind::body))
          fail(link, "Mass per length", what,
               "half of its mass would go to a body, which brings its own; set it to 0");
        if (link.moving())
        {
          check_sliding(scene, link, what, end_time);
          check_wave_speed(scene, link, end_time);
        }
        else if (moves(link) || !link.profile.is_zero())
          fail(link, "Speed", what, "Speed and Height profile are for a sliding contact");
        if (!link.cant.is_zero() && !(link.moving() && link.to.kind == Attachment::Kind::wire &&
                                      scene.wires[link.to.index].has_lateral))
          fail(link, "Cant", what, "it is for a sliding contact on a wire that moves sideways");
        if (link.cant.depends_on_time())
          fail(link, "Cant", what, "a track does not move; write a formula in s");
      }
    }
  } // namespace

  void check_wires(const Scene &scene)
  {
    for (const Wire &wire : scene.wires)
      check_wire(wire);
    check_supports(scene);
    for (const Load &load : scene.loads)
      if (load.target.kind == Attachment::Kind::wire && load.kind != Load::Kind::distributed)
        check_position(scene, load.target.index, load.target.position, load, "On",
                       "load '" + load.name + "': ");
  }

  void check(const Scene &scene, const double end_time)
  {
    if (scene.wires.empty() && scene.masses.empty() && scene.bodies.empty())
      throw EntryError("", "the scene is empty: name at least one wire or mass");
    check_values(scene);
    check_names(scene);
    check_wires(scene);
    check_masses(scene);
    check_links(scene, end_time);
    for (const Load &load : scene.loads)
    {
      const std::string what = "load '" + load.name + "': ";
      if (load.target.kind == Attachment::Kind::ground)
        fail(load, "On", what, "a load on the ground moves nothing");
      if (load.kind != Load::Kind::point && load.target.kind != Attachment::Kind::wire)
        fail(load, "On", what, "a distributed or moving load acts on a wire");
      check_attachment(scene, load.target, load.rotational, load, "On", what);
      if (load.kind == Load::Kind::moving)
        check_wave_speed(scene, load, end_time);
      if (!can_move(scene, load.target, load.rotational, load.direction))
        fail(load, load.rotational ? "Axis" : "Direction", what, "its target cannot ",
             load.rotational ? "turn about" : "move along",
             " it; add a motion or a component, or change it");
    }
    for (const Probe &probe : scene.probes)
    {
      const std::string what = "probe '" + probe.name + "': ";
      if (probe.point.kind == Attachment::Kind::ground)
        fail(probe, "Point", what, "the ground does not move");
      check_attachment(scene, probe.point, probe.rotational, probe, "Point", what);
      if (!can_move(scene, probe.point, probe.rotational, probe.direction))
        fail(probe, probe.rotational ? "Axis" : "Direction", what, "the point cannot ",
             probe.rotational ? "turn about" : "move along",
             " it; add a motion or a component, or change it");
    }
  }
} // namespace taut
