// SPDX-License-Identifier: LGPL-2.1-or-later
#include "network.h"

#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/scene/entries.h>
#include <taut/scene/named_items.h>
#include <taut/scene/network_entries.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace taut
{
  namespace
  {
    /// With the digits from which it is read back to the last bit.
    std::string number(const double value)
    {
      return to_text(std::setprecision(17), value);
    }

    std::string numbers(const std::vector<double> &values)
    {
      std::string text;
      for (const double value : values)
        text += (text.empty() ? "" : ", ") + number(value);
      return text;
    }

    std::string coordinates(const Coordinates &p)
    {
      return p.z == 0. && !std::signbit(p.z) ? numbers({p.x, p.y}) : numbers({p.x, p.y, p.z});
    }

    /// Whether the signs of zeros agree, too.
    bool is_same(const double a, const double b)
    {
      return a == b && std::signbit(a) == std::signbit(b);
    }

    bool is_same(const Coordinates &a, const Coordinates &b)
    {
      return is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z);
    }

    /// A vector from which the reader makes this unit vector: to divide by a length rounds, so that
    /// not each is one that the vector itself gives.
    Coordinates vector_of(const Coordinates &direction)
    {
      constexpr int most = 4096;
      for (int k = 0; k < most; ++k)
      {
        const double factor = 1. + k / 1024.;
        const Coordinates longer = {factor * direction.x, factor * direction.y,
                                    factor * direction.z};
        if (is_same(unit(longer, ""), direction))
          return longer;
      }
      return direction;
    }

    /// Entries of one list of items, each in a section of its own.
    class Items
    {
    public:
      Items(std::vector<WrittenEntry> &all, std::string list, std::string section)
          : all(all), section(std::move(section))
      {
        all.push_back({{"Network", std::move(list)}, ""});
        place_of_names = all.size() - 1;
      }

      /// Begins the section of an item. A name that another item has gets a number.
      void begin(const std::string &given)
      {
        std::string own = given;
        for (int k = 2; !names.insert(own).second; ++k)
          own = given + " " + std::to_string(k);
        check_item_names({own}, "");
        if (own.find(',') != std::string::npos || trim(own) != own)
          throw UserError("'" + own +
                          "' cannot be a name in a parameter file: lists of names have "
                          "commas between them; give it another name");
        std::string &list = all[place_of_names].value;
        list += (list.empty() ? "" : ", ") + own;
        name = own;
      }

      void set(const std::string &entry, const std::string &value)
      {
        all.push_back({{"Network", section + " " + name, entry}, value});
      }

      void set_text(const std::string &usual, const std::string &entry, const std::string &value)
      {
        if (value != usual)
          set(entry, value);
      }

      void set_number(const double usual, const std::string &entry, const double value)
      {
        if (!is_same(value, usual))
          set(entry, number(value));
      }

      void set_flag(const bool usual, const std::string &entry, const bool value)
      {
        if (value != usual)
          set(entry, value ? "true" : "false");
      }

      /// Direction of a displacement or force, or axis of a rotation or moment.
      void set_direction(const bool rotational, const Coordinates &direction, const bool is_usual)
      {
        set_flag(false, "Rotational", rotational);
        if (!is_usual ||
            !is_same(direction, rotational ? Coordinates{0., 0., 1.} : Coordinates{0., 1.}))
          set(rotational ? "Axis" : "Direction", coordinates(vector_of(direction)));
      }

    private:
      std::vector<WrittenEntry> &all;
      std::size_t place_of_names;
      std::string section, name;
      std::set<std::string> names;
    };

    std::string text_of(const Scene &scene, const Attachment &at)
    {
      switch (at.kind)
      {
      case Attachment::Kind::wire:
        return scene.wires[at.index].name + " @ " + number(at.position);
      case Attachment::Kind::body:
        return scene.bodies[at.index].name + " @ " + coordinates(at.place);
      case Attachment::Kind::mass:
        return scene.masses[at.index].name +
               (at.place == Coordinates() ? std::string() : " @ " + coordinates(at.place));
      default:
        return at.has_place ? "ground @ " + coordinates(at.place) : "ground";
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

    void write_start(Items &items, const std::string &component, const InitialMotion &start)
    {
      items.set_text("0", "Initial " + component + " displacement", start.displacement.formula());
      items.set_text("0", "Initial " + component + " velocity", start.velocity.formula());
    }

    void write_wire(Items &items, const Wire &wire)
    {
      items.begin(wire.name);
      items.set("From", coordinates(wire.a));
      items.set("To", coordinates(wire.b));
      std::string components = wire.has_axial ? "bar" : "";
      const auto add = [&](const std::string &component)
      { components += (components.empty() ? "" : ", ") + component; };
      if (wire.transverse != TransverseKind::none)
        add(wire.transverse == TransverseKind::beam ? "beam" : "string");
      if (wire.has_lateral)
        add("lateral");
      items.set("Components", components);
      items.set("Mass per length", number(wire.mass_per_length));
      items.set_number(0., "Axial stiffness", wire.axial_stiffness);
      items.set_number(0., "Tension", wire.tension);
      items.set_number(0., "Bending stiffness", wire.bending_stiffness);
      items.set_text("2", "Degree", std::to_string(wire.degree));
      items.set_text("consistent", "Mass matrix",
                     wire.mass_matrix == MassMatrix::lumped    ? "lumped"
                     : wire.mass_matrix == MassMatrix::reduced ? "reduced"
                                                               : "consistent");
      items.set("Element size", number(wire.element_size));
      items.set_number(0., "Mass damping", wire.damping.mass);
      items.set_number(0., "Stiffness damping", wire.damping.stiffness);
      items.set_number(0., "Foundation stiffness", wire.foundation_stiffness);
      items.set_number(0., "Foundation damping", wire.foundation_damping);
      std::string changes;
      for (const TensionChange &c : wire.tension_changes)
        changes += (changes.empty() ? "" : "; ") + numbers({c.from, c.to, c.change});
      items.set_text("", "Tension changes", changes);
      items.set_flag(true, "Weight", wire.weight);
      write_start(items, "axial", wire.axial_start);
      write_start(items, "transverse", wire.transverse_start);
      write_start(items, "lateral", wire.lateral_start);
    }

    void write_wires(const Scene &scene, std::vector<WrittenEntry> &all)
    {
      Items wires(all, "Wires", "Wire");
      for (const Wire &wire : scene.wires)
        write_wire(wires, wire);
      Items supports(all, "Supports", "Support");
      for (const Support &support : scene.supports)
      {
        supports.begin(support.name);
        supports.set("Wire", scene.wires[support.wire].name);
        supports.set("Positions", numbers(support.positions));
        supports.set_text("transverse", "Motion", text_of(support.motion));
        supports.set_text("fixed", "Type", support.fixed ? "fixed" : "elastic");
        supports.set_text("0", "Displacement", support.prescribed.formula());
        supports.set_number(0., "Stiffness", support.stiffness);
        supports.set_number(0., "Damping", support.damping);
      }
      Items point_masses(all, "Point masses", "Point mass");
      for (const PointMass &mass : scene.point_masses)
      {
        point_masses.begin(mass.name);
        point_masses.set("Wire", scene.wires[mass.wire].name);
        point_masses.set("Positions", numbers(mass.positions));
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
      Items masses(all, "Masses", "Mass");
      for (const Mass &mass : scene.masses)
      {
        masses.begin(mass.name);
        masses.set("Position", coordinates(mass.position));
        if (mass.travel)
          throw UserError("mass '" + mass.name +
                          "' has a way that is not written out; its parameter file says it");
        std::string motions;
        for (int k = 0; k < 4; ++k)
          if (mass.moves[k])
            motions += (motions.empty() ? "" : ", ") + std::string(motion_names[k]);
        masses.set_text("y", "Motions", motions);
        masses.set_number(0., "Mass", mass.mass);
        masses.set_number(0., "Inertia", mass.inertia);
        masses.set_flag(true, "Weight", mass.weight);
        masses.set_text("0, 0, 0", "Initial displacement", numbers(motions_of(mass.displacement)));
        masses.set_text("0, 0, 0", "Initial velocity", numbers(motions_of(mass.velocity)));
        for (int k = 0; k < 4; ++k)
          if (mass.is_prescribed[k])
            masses.set(std::string("Prescribed ") + motion_names[k], mass.prescribed[k].formula());
        masses.set_number(0., "Speed", mass.speed);
      }
      Items springs(all, "Springs", "Spring");
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

    void write_law(Items &items, const Link &link)
    {
      const auto entries = link.law->entries();
      if (entries.empty())
        throw UserError("link '" + link.name + "' has a law of a program, which no entry says");
      for (const auto &[entry, value] : entries)
        items.set(entry, value);
    }

    void write_link(Items &items, const Link &link, const Scene &scene)
    {
      const bool has_length = link.unstressed_length > 0.;
      if (has_length && !link.turns && link.gap != gap_of_length(link, scene))
        throw UserError(
            "link '" + link.name +
            "' has a Length and a Gap that does not follow from it, which no entry says");
      if (link.travel)
        throw UserError("link '" + link.name +
                        "' has a way that is not written out; its parameter file says it");
      if (link.turns)
        items.set("Turns", "true");
      else
        items.set_direction(link.rotational, link.direction, false);
      if (link.law)
        write_law(items, link);
      else
        items.set_text("rigid", "Stiffness", link.rigid() ? "rigid" : number(link.stiffness));
      items.set_number(0., "Damping", link.damping);
      if (has_length)
        items.set("Length", number(link.unstressed_length));
      else
        items.set_number(0., "Gap", link.gap);
      items.set_number(0., "Speed", link.speed);
      items.set_flag(false, "Faster than waves", link.faster_than_waves);
      items.set_flag(false, "Straight", link.straight);
      items.set_text("0", "Height profile", link.profile.formula());
      items.set_flag(false, "Find length", link.form.find_length);
      items.set_flag(false, "Find direction", link.form.find_direction);
      items.set_number(0., "Prescribed displacement", link.form.prescribed_displacement);
      items.set_number(0., "Axial stiffness", link.form.axial_stiffness);
      items.set_number(0., "Mass per length", link.form.mass_per_length);
    }

    void write_links(const Scene &scene, std::vector<WrittenEntry> &all)
    {
      Items links(all, "Links", "Link");
      for (const Link &link : scene.links)
      {
        links.begin(link.name);
        links.set_text("joint", "Type", text_of(link.kind));
        links.set("From", text_of(scene, link.from));
        links.set("To", text_of(scene, link.to));
        links.set_text("", "Strip", link.strip);
        write_link(links, link, scene);
      }
    }

    void write_loads(const Scene &scene, std::vector<WrittenEntry> &all)
    {
      Items loads(all, "Loads", "Load");
      for (const Load &load : scene.loads)
      {
        if (load.travel)
          throw UserError("load '" + load.name +
                          "' has a way that is not written out; its parameter file says it");
        loads.begin(load.name);
        loads.set_text("point", "Type",
                       load.kind == Load::Kind::distributed ? "distributed"
                       : load.kind == Load::Kind::moving    ? "moving"
                                                            : "point");
        loads.set("On", text_of(scene, load.target));
        loads.set_direction(load.rotational, load.direction, true);
        loads.set("Magnitude", load.magnitude.formula());
        loads.set_number(0., "Speed", load.speed);
        loads.set_flag(false, "Faster than waves", load.faster_than_waves);
        loads.set_flag(true, "Acts while built", load.acts_while_built);
      }
      Items probes(all, "Probes", "Probe");
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
