// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/network.h"
#include "scene/written_items.h"

#include "scene/network_entries.h"
#include "scene/travel.h"
#include <taut/base/exceptions.h>

namespace taut
{
  namespace
  {
    std::string text_of(const Scene &scene, const Attachment &at)
    {
      switch (at.kind)
      {
      case Attachment::Kind::wire:
        return scene.wires[at.index].name + " @ " + written_number(at.position);
      case Attachment::Kind::body:
        return scene.bodies[at.index].name + " @ " + written_coordinates(at.place);
      case Attachment::Kind::mass:
        return scene.masses[at.index].name +
               (at.place == Coordinates() ? std::string() : " @ " + written_coordinates(at.place));
      default:
        return at.has_place ? "ground @ " + written_coordinates(at.place) : "ground";
      }
    }

    std::string text_of(const WireMotion motion)
    {
      switch (motion)
      {
      case WireMotion::axial:
        return "axial";
      case WireMotion::slope:
        return "slope";
      case WireMotion::lateral:
        return "lateral";
      case WireMotion::lateral_slope:
        return "lateral slope";
      default:
        return "transverse";
      }
    }

    /// Of a mass, a link or a load.
    template <typename Item>
    void write_speed(WrittenItems &items, const Item &item)
    {
      if (item.travel)
        items.set("Speed", item.travel->formula());
      else
        items.set_number(0., "Speed", item.speed);
    }

    void write_start(WrittenItems &items, const std::string &component, const InitialMotion &start)
    {
      items.set_text("0", "Initial " + component + " displacement", start.displacement.formula());
      items.set_text("0", "Initial " + component + " velocity", start.velocity.formula());
    }

    void write_wire(WrittenItems &items, const Wire &wire)
    {
      items.begin(wire.name);
      items.set("From", written_coordinates(wire.a));
      items.set("To", written_coordinates(wire.b));
      std::string components = wire.has_axial ? "bar" : "";
      const auto add = [&](const std::string &component)
      { components += (components.empty() ? "" : ", ") + component; };
      if (wire.transverse != TransverseKind::none)
        add(wire.transverse == TransverseKind::beam ? "beam" : "string");
      if (wire.has_lateral)
        add("lateral");
      items.set("Components", components);
      items.set("Mass per length", written_number(wire.mass_per_length));
      items.set_number(0., "Axial stiffness", wire.axial_stiffness);
      items.set_number(0., "Tension", wire.tension);
      items.set_number(0., "Bending stiffness", wire.bending_stiffness);
      const auto set_remaining = [&](const std::string &of, const Expression &share)
      { items.set_text("1", "Remaining " + of, share.is_zero() ? "1" : share.formula()); };
      set_remaining("mass", wire.remaining.mass);
      set_remaining("axial stiffness", wire.remaining.axial_stiffness);
      set_remaining("bending stiffness", wire.remaining.bending_stiffness);
      items.set_text("2", "Degree", std::to_string(wire.degree));
      items.set_text("consistent", "Mass matrix",
                     wire.mass_matrix == MassMatrix::lumped    ? "lumped"
                     : wire.mass_matrix == MassMatrix::reduced ? "reduced"
                                                               : "consistent");
      items.set("Element size", written_number(wire.element_size));
      items.set_number(0., "Mass damping", wire.damping.mass);
      items.set_number(0., "Stiffness damping", wire.damping.stiffness);
      items.set_number(0., "Foundation stiffness", wire.foundation_stiffness);
      items.set_number(0., "Foundation damping", wire.foundation_damping);
      std::string changes;
      for (const TensionChange &c : wire.tension_changes)
        changes += (changes.empty() ? "" : "; ") + written_numbers({c.from, c.to, c.change});
      items.set_text("", "Tension changes", changes);
      items.set_flag(true, "Weight", wire.weight);
      write_start(items, "axial", wire.axial_start);
      write_start(items, "transverse", wire.transverse_start);
      write_start(items, "lateral", wire.lateral_start);
    }

    void write_wires(const Scene &scene, std::vector<WrittenEntry> &all)
    {
      WrittenItems wires(all, "Wires", "Wire");
      for (const Wire &wire : scene.wires)
        write_wire(wires, wire);
      WrittenItems supports(all, "Supports", "Support");
      for (const Support &support : scene.supports)
      {
        supports.begin(support.name);
        supports.set("Wire", scene.wires[support.wire].name);
        supports.set("Positions", written_numbers(support.positions));
        supports.set_text("transverse", "Motion", text_of(support.motion));
        supports.set_text("fixed", "Type", support.fixed ? "fixed" : "elastic");
        supports.set_text("0", "Displacement", support.prescribed.formula());
        supports.set_number(0., "Stiffness", support.stiffness);
        supports.set_number(0., "Damping", support.damping);
      }
      WrittenItems point_masses(all, "Point masses", "Point mass");
      for (const PointMass &mass : scene.point_masses)
      {
        point_masses.begin(mass.name);
        point_masses.set("Wire", scene.wires[mass.wire].name);
        point_masses.set("Positions", written_numbers(mass.positions));
        point_masses.set_number(0., "Mass", mass.mass);
        point_masses.set_flag(true, "Weight", mass.weight);
      }
    }

    /// Motions of a mass at the start; the last one only if it is not 0.
    std::vector<double> motions_of(const double (&values)[4])
    {
      return {values, values + (values[3] == 0. ? 3 : 4)};
    }

    void write_mechanisms(const Scene &scene, std::vector<WrittenEntry> &all)
    {
      WrittenItems masses(all, "Masses", "Mass");
      for (const Mass &mass : scene.masses)
      {
        masses.begin(mass.name);
        masses.set("Position", written_coordinates(mass.position));
        std::string motions;
        for (int k = 0; k < 4; ++k)
          if (mass.moves[k])
            motions += (motions.empty() ? "" : ", ") + std::string(motion_names[k]);
        masses.set_text("y", "Motions", motions);
        masses.set_number(0., "Mass", mass.mass);
        masses.set_number(0., "Inertia", mass.inertia);
        masses.set_flag(true, "Weight", mass.weight);
        masses.set_text("0, 0, 0", "Initial displacement",
                        written_numbers(motions_of(mass.displacement)));
        masses.set_text("0, 0, 0", "Initial velocity", written_numbers(motions_of(mass.velocity)));
        for (int k = 0; k < 4; ++k)
          if (mass.is_prescribed[k])
            masses.set(std::string("Prescribed ") + motion_names[k], mass.prescribed[k].formula());
        write_speed(masses, mass);
      }
      WrittenItems springs(all, "Springs", "Spring");
      for (const Spring &spring : scene.springs)
      {
        const auto end = [&](const std::size_t mass)
        { return mass == ground ? "ground" : scene.masses[mass].name; };
        springs.begin(spring.name);
        springs.set("From", end(spring.from));
        springs.set("To", end(spring.to));
        if (spring.rotational)
          springs.set("Rotational", "true");
        else
          springs.set_direction(false, spring.direction, true);
        springs.set_number(0., "Stiffness", spring.stiffness);
        springs.set_number(0., "Damping", spring.damping);
      }
    }

    std::string text_of(const LinkKind kind)
    {
      switch (kind)
      {
      case LinkKind::stop:
        return "stop";
      case LinkKind::dropper:
        return "dropper";
      case LinkKind::sliding_contact:
        return "sliding contact";
      default:
        return "joint";
      }
    }

    void write_law(WrittenItems &items, const Link &link)
    {
      const auto entries = link.law->entries();
      if (entries.empty())
        throw UserError("link '" + link.name + "' has a law of a program, which no entry says");
      for (const auto &[entry, value] : entries)
        items.set(entry, value);
    }

    void write_link(WrittenItems &items, const Link &link, const Scene &scene)
    {
      const bool has_length = link.unstressed_length > 0.;
      if (has_length && !link.turns && link.gap != gap_of_length(link, scene))
        throw UserError(
            "link '" + link.name +
            "' has a Length and a Gap that does not follow from it, which no entry says");
      if (!link.cant.is_zero())
        throw UserError("link '" + link.name +
                        "' has a strip that the cant of the track turns, "
                        "which no entry says");
      if (link.turns)
        items.set("Turns", "true");
      else
        items.set_direction(link.rotational, link.direction, false);
      if (link.law)
        write_law(items, link);
      else
        items.set_text("rigid", "Stiffness",
                       link.rigid() ? "rigid" : written_number(link.stiffness));
      items.set_number(0., "Damping", link.damping);
      if (has_length)
        items.set("Length", link.length_in_time.is_zero() ? written_number(link.unstressed_length)
                                                          : link.length_in_time.formula());
      else
        items.set_number(0., "Gap", link.gap);
      write_speed(items, link);
      items.set_flag(false, "Faster than waves", link.faster_than_waves);
      items.set_flag(false, "Straight", link.straight);
      items.set_text("0", "Height profile", link.profile.formula());
      items.set_flag(false, "Find length", link.form.find_length);
      items.set_flag(false, "Find direction", link.form.find_direction);
      items.set_number(0., "Prescribed displacement", link.form.prescribed_displacement);
      items.set_number(0., "Axial stiffness", link.form.axial_stiffness);
      items.set_number(0., "Mass per length", link.form.mass_per_length);
      items.set_number(0., "Pull", link.form.pull);
    }

    void write_links(const Scene &scene, std::vector<WrittenEntry> &all)
    {
      WrittenItems links(all, "Links", "Link");
      for (const Link &link : scene.links)
      {
        links.begin(link.name);
        links.set_text("joint", "Type", text_of(link.kind));
        links.set("From", text_of(scene, link.from));
        links.set("To", text_of(scene, link.to));
        std::string rings;
        for (const Attachment &ring : link.through)
          rings += (rings.empty() ? "" : ", ") + text_of(scene, ring);
        links.set_text("", "Through", rings);
        links.set_text("", "Strip", link.strip);
        write_link(links, link, scene);
      }
    }

    void write_loads(const Scene &scene, std::vector<WrittenEntry> &all)
    {
      WrittenItems loads(all, "Loads", "Load");
      for (const Load &load : scene.loads)
      {
        loads.begin(load.name);
        loads.set_text("point", "Type",
                       load.kind == Load::Kind::distributed ? "distributed"
                       : load.kind == Load::Kind::moving    ? "moving"
                                                            : "point");
        loads.set("On", text_of(scene, load.target));
        loads.set_direction(load.rotational, load.direction, true);
        loads.set("Magnitude", load.magnitude.formula());
        write_speed(loads, load);
        loads.set_flag(false, "Faster than waves", load.faster_than_waves);
        loads.set_flag(true, "Acts while built", load.acts_while_built);
      }
      WrittenItems probes(all, "Probes", "Probe");
      for (const Probe &probe : scene.probes)
      {
        probes.begin(probe.name);
        probes.set("Point", text_of(scene, probe.point));
        probes.set_direction(probe.rotational, probe.direction, true);
        probes.set_text("displacement", "Quantity",
                        probe.quantity == Probe::Quantity::velocity       ? "velocity"
                        : probe.quantity == Probe::Quantity::acceleration ? "acceleration"
                                                                          : "displacement");
      }
    }
  } // namespace

  std::vector<WrittenEntry> network_entries(const Scene &scene)
  {
    std::vector<WrittenEntry> all;
    write_wires(scene, all);
    write_mechanisms(scene, all);
    write_links(scene, all);
    write_loads(scene, all);
    return all;
  }
} // namespace taut
