// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/scene/scene.h>

#include <cmath>
#include <set>
#include <sstream>

namespace taut
{
  namespace
  {
    template <typename... Parts>
    void fail(const Parts &...parts)
    {
      std::ostringstream out;
      (out << ... << parts);
      throw UserError(out.str());
    }

    void check_wire(const Wire &wire)
    {
      const double length = wire.length();
      if (!(length > 0.) || !std::isfinite(length))
        fail("wire '", wire.name, "': its ends From and To are at one place; give it a length");
      if (!wire.has_axial && wire.transverse == TransverseKind::none)
        fail("wire '", wire.name, "': no Components; name at least one of bar, string, beam");
      if (!(wire.mass_per_length > 0.))
        fail("wire '", wire.name, "': Mass per length must be positive, got ", wire.mass_per_length,
             " kg/m");
      if (!(wire.element_size > 0.))
        fail("wire '", wire.name, "': Element size must be positive");
      constexpr double most_elements = 2e7;
      if (length / wire.element_size > most_elements)
        fail("wire '", wire.name, "': ", length / wire.element_size,
             " elements are too many; raise Element size");
      if (wire.has_axial && !(wire.axial_stiffness > 0.))
        fail("wire '", wire.name, "': a bar needs a positive Axial stiffness");
      if (wire.transverse == TransverseKind::string && !(wire.tension > 0.))
        fail("wire '", wire.name, "': a string needs a positive Tension");
      if (wire.transverse == TransverseKind::beam && !(wire.bending_stiffness > 0.))
        fail("wire '", wire.name,
             "': a beam needs a positive Bending stiffness; without one, use the component string");
    }

    void check_position(const Scene &scene, const std::size_t wire, const double s,
                        const std::string &what)
    {
      const double length = scene.wires[wire].length();
      if (!(s >= 0. && s <= length * (1. + 1e-12)))
        fail(what, ": position ", s, " m is outside wire '", scene.wires[wire].name, "' (0 to ",
             length, " m)");
    }

    void check_attachment(const Scene &scene, const Attachment &end, const bool rotational,
                          const std::string &what)
    {
      if (end.kind == Attachment::Kind::ground)
        return;
      if (end.kind == Attachment::Kind::mass)
      {
        if (rotational && !scene.masses[end.index].moves[2])
          fail(what, ": mass '", scene.masses[end.index].name,
               "' does not rotate; add 'rotation' to its Motions");
        return;
      }
      check_position(scene, end.index, end.position, what);
      if (rotational && scene.wires[end.index].transverse != TransverseKind::beam)
        fail(what, ": wire '", scene.wires[end.index].name,
             "' has no slope to hold; a moment or an angular gap needs the component beam");
    }

    void check_supports(const Scene &scene)
    {
      for (const Support &support : scene.supports)
      {
        const Wire &wire = scene.wires[support.wire];
        const std::string what = "support '" + support.name + "'";
        if (support.positions.empty())
          fail(what, ": no Positions");
        for (const double s : support.positions)
          check_position(scene, support.wire, s, what);
        if (support.motion == WireMotion::axial && !wire.has_axial)
          fail(what, ": wire '", wire.name, "' has no component bar to hold along it");
        if (support.motion == WireMotion::transverse && wire.transverse == TransverseKind::none)
          fail(what, ": wire '", wire.name, "' has no component string or beam to hold across it");
        if (support.motion == WireMotion::slope && wire.transverse != TransverseKind::beam)
          fail(what, ": wire '", wire.name, "' has no slope; only the component beam has");
        if (!support.fixed && support.stiffness == 0. && support.damping == 0.)
          fail(what, ": an elastic support needs a Stiffness or a Damping");
      }
      for (const PointMass &mass : scene.point_masses)
        for (const double s : mass.positions)
          check_position(scene, mass.wire, s, "point mass '" + mass.name + "'");
    }

    void check_masses(const Scene &scene)
    {
      for (const Mass &mass : scene.masses)
        if (mass.inertia > 0. && !mass.moves[2])
          fail("mass '", mass.name, "': it has an Inertia but 'rotation' is not among its Motions");
      for (const Spring &spring : scene.springs)
      {
        const std::string what = "spring '" + spring.name + "'";
        for (const std::size_t end : {spring.from, spring.to})
          if (end != ground)
          {
            const Mass &mass = scene.masses[end];
            const bool moves = spring.rotational ? mass.moves[2]
                                                 : ((mass.moves[0] && spring.direction.x != 0.) ||
                                                    (mass.moves[1] && spring.direction.y != 0.));
            if (!moves)
              fail(what, ": mass '", mass.name, "' cannot move in the direction of the spring");
          }
        if (spring.stiffness == 0. && spring.damping == 0.)
          fail(what, ": it has neither Stiffness nor Damping");
      }
    }

    void check_links(const Scene &scene, const double end_time)
    {
      for (const Link &link : scene.links)
      {
        const std::string what = "link '" + link.name + "'";
        check_attachment(scene, link.from, link.rotational, what + ", From");
        check_attachment(scene, link.to, link.rotational, what + ", To");
        if (link.from.kind == Attachment::Kind::ground && link.to.kind == Attachment::Kind::ground)
          fail(what, ": both ends are the ground");
        if (link.damping > 0. && link.rigid())
          fail(what, ": a rigid link has no Damping; give it a finite Stiffness");
        if (link.find_length &&
            (link.kind != LinkKind::dropper || link.from.kind == Attachment::Kind::ground ||
             link.to.kind == Attachment::Kind::ground))
          fail(what, ": Find length is for a dropper between two bodies");
        if (!link.moving())
        {
          if (link.speed != 0. || !link.profile.is_zero())
            fail(what, ": Speed and Height profile are for a sliding contact");
          continue;
        }
        if (link.to.kind != Attachment::Kind::wire)
          fail(what, ", To: a sliding contact slides on a wire, 'wire @ start'");
        const double end = link.to.position + link.speed * end_time;
        const double length = scene.wires[link.to.index].length();
        if (!(end >= -1e-9 * length && end <= (1. + 1e-9) * length))
          fail("sliding contact '", link.name, "' leaves wire '", scene.wires[link.to.index].name,
               "' before the end: at t = ", end_time, " s it would be at ", end, " m of ", length,
               " m. Shorten the End time or lengthen the wire");
      }
    }

    template <typename Item>
    void check_names(const std::vector<Item> &items, const std::string &kind)
    {
      std::set<std::string> names;
      for (const Item &item : items)
        if (item.name.empty() || !names.insert(item.name).second)
          fail("two ", kind, " are called '", item.name, "'; names are unique and not empty");
    }
  } // namespace

  void check(const Scene &scene, const double end_time)
  {
    if (scene.wires.empty() && scene.masses.empty())
      fail("the scene is empty: name at least one wire or mass");
    check_names(scene.wires, "wires");
    check_names(scene.masses, "masses");
    check_names(scene.links, "links");
    for (const Wire &wire : scene.wires)
      check_wire(wire);
    check_supports(scene);
    check_masses(scene);
    check_links(scene, end_time);
    for (const Load &load : scene.loads)
    {
      if (load.target.kind == Attachment::Kind::ground)
        fail("load '", load.name, "', On: a load on the ground moves nothing");
      if (load.kind != Load::Kind::point && load.target.kind != Attachment::Kind::wire)
        fail("load '", load.name, "', On: a distributed or moving load acts on a wire");
      check_attachment(scene, load.target, load.rotational, "load '" + load.name + "', On");
    }
    for (const Probe &probe : scene.probes)
    {
      if (probe.point.kind == Attachment::Kind::ground)
        fail("probe '", probe.name, "', Point: the ground does not move");
      check_attachment(scene, probe.point, probe.rotational, "probe '" + probe.name + "', Point");
    }
  }
} // namespace taut
