// SPDX-License-Identifier: LGPL-2.1-or-later Checks of values that a parameter file cannot have,
// but a generator of a plugin or a program can.
#include "scene/check_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    constexpr unsigned int most_degree = 4; ///< blocks of the matrices of a wire have up to 4 DoFs

    /// Largest deviation of the length of a direction from one: far above rounding, far below the
    /// accuracy of results.
    constexpr double same_length = 1e-8;

    bool is_finite(const Coordinates &x)
    {
      return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
    }

    /// Checks the values of one item; messages begin with its kind and name.
    template <typename Item>
    class Values
    {
    public:
      Values(const Item &item, const std::string &kind)
          : item(item), what(kind + " '" + item.name + "': ")
      {
      }

      void finite(const double value, const std::string &entry) const
      {
        if (!std::isfinite(value))
          fail(item, entry, what, "its ", entry, " is ", value, "; take a finite number");
      }
      void finite(const Coordinates &value, const std::string &entry) const
      {
        for (const unsigned int c : {0, 1, 2})
          finite(value[c], entry);
      }
      void not_negative(const double value, const std::string &entry) const
      {
        if (!(value >= 0.) || std::isinf(value))
          fail(item, entry, what, "its ", entry, " is ", value,
               "; take a finite number that is not negative");
      }
      void unit(const Coordinates &value, const std::string &entry) const
      {
        if (!(std::fabs(norm(value) - 1.) <= same_length))
          fail(item, entry, what, "its ", entry, " has the length ", norm(value),
               "; take a unit vector");
      }
      void constant(const Expression &value, const std::string &entry) const
      {
        if (!std::isfinite(value.constant_part()))
          fail(item, entry, what, "its ", entry, " is ", value.constant_part(),
               "; take a finite number");
      }
      void index(const std::size_t value, const std::size_t n, const std::string &kinds,
                 const std::string &entry) const
      {
        if (value >= n)
          fail(item, entry, what, "it names number ", value, " of the ", kinds,
               ", and the scene has ", n, ", counted from 0");
      }
      void attachment(const Scene &scene, const Attachment &at, const std::string &entry) const
      {
        if (at.kind == Attachment::Kind::wire)
          index(at.index, scene.wires.size(), "wires", entry);
        if (at.kind == Attachment::Kind::mass)
          index(at.index, scene.masses.size(), "masses", entry);
        if (at.kind == Attachment::Kind::body)
          index(at.index, scene.bodies.size(), "bodies", entry);
        finite(at.position, entry);
        finite(at.place, entry);
      }

    private:
      const Item &item;
      const std::string what;
    };

    void check_wire_values(const Scene &scene)
    {
      for (const Wire &wire : scene.wires)
      {
        const Values of(wire, "wire");
        of.finite(wire.a, "From");
        of.finite(wire.b, "To");
        of.not_negative(wire.mass_per_length, "Mass per length");
        of.not_negative(wire.axial_stiffness, "Axial stiffness");
        of.not_negative(wire.tension, "Tension");
        of.not_negative(wire.bending_stiffness, "Bending stiffness");
        of.not_negative(wire.damping.mass, "Mass damping");
        of.not_negative(wire.damping.stiffness, "Stiffness damping");
        of.not_negative(wire.foundation_stiffness, "Foundation stiffness");
        of.not_negative(wire.foundation_damping, "Foundation damping");
        if (wire.degree < 1 || wire.degree > most_degree)
          fail(wire, "Degree", "wire '", wire.name, "': its Degree is ", wire.degree,
               "; take 1 to ", most_degree);
      }
      for (const Support &support : scene.supports)
      {
        const Values of(support, "support");
        of.index(support.wire, scene.wires.size(), "wires", "Wire");
        of.constant(support.prescribed, "Displacement");
        of.not_negative(support.stiffness, "Stiffness");
        of.not_negative(support.damping, "Damping");
      }
      for (const PointMass &mass : scene.point_masses)
      {
        const Values of(mass, "point mass");
        of.index(mass.wire, scene.wires.size(), "wires", "Wire");
        of.not_negative(mass.mass, "Mass");
      }
    }

    void check_mass_values(const Scene &scene)
    {
      for (const Mass &mass : scene.masses)
      {
        const Values of(mass, "mass");
        of.finite(mass.position, "Position");
        of.not_negative(mass.mass, "Mass");
        of.not_negative(mass.inertia, "Inertia");
        for (const double value : mass.displacement)
          of.finite(value, "Initial displacement");
        for (const double value : mass.velocity)
          of.finite(value, "Initial velocity");
        if (std::none_of(std::begin(mass.moves), std::end(mass.moves), [](bool m) { return m; }))
          fail(mass, "Motions", "mass '", mass.name,
               "': it has none; name at least one, or prescribe one");
      }
      for (const Spring &spring : scene.springs)
      {
        const Values of(spring, "spring");
        for (const std::size_t end : {spring.from, spring.to})
          if (end != ground)
            of.index(end, scene.masses.size(), "masses", end == spring.from ? "From" : "To");
        of.unit(spring.direction, "Direction");
        of.not_negative(spring.stiffness, "Stiffness");
        of.not_negative(spring.damping, "Damping");
      }
    }

    void check_stiffness(const Link &link)
    {
      const std::string what = "link '" + link.name + "': ";
      if (!(link.stiffness > 0.))
        fail(link, "Stiffness", what, "its Stiffness is ", link.stiffness,
             "; take a positive number, or leave it rigid");
      if (link.law && !link.unilateral())
        fail(link, "Law", what, "a law is for a stop, dropper or sliding contact");
      if (link.law && link.stiffness != link.law->largest_stiffness())
        fail(link, "Law", what, "with a law its Stiffness is the largest one of that, ",
             link.law->largest_stiffness(), ", not ", link.stiffness);
    }

    void check_link_values(const Scene &scene)
    {
      for (const Link &link : scene.links)
      {
        const Values of(link, "link");
        of.attachment(scene, link.from, "From");
        of.attachment(scene, link.to, "To");
        for (const Attachment &ring : link.through)
          of.attachment(scene, ring, "Through");
        if (!link.turns)
          of.unit(link.direction, link.rotational ? "Axis" : "Direction");
        check_stiffness(link);
        of.not_negative(link.damping, "Damping");
        of.finite(link.gap, "Gap");
        of.not_negative(link.unstressed_length, "Length");
        if (!link.length_in_time.is_zero() &&
            !(link.turns && link.length_in_time(0., 0.) == link.unstressed_length))
          throw EntryError(link.origin, "link '" + link.name +
                                            "' has a length over time and another one at t = 0, or "
                                            "does not turn");
        of.finite(link.speed, "Speed");
        of.constant(link.profile, "Height profile");
        of.constant(link.cant, "Cant");
        of.finite(link.form.prescribed_displacement, "Prescribed displacement");
        of.not_negative(link.form.axial_stiffness, "Axial stiffness");
        of.not_negative(link.form.mass_per_length, "Mass per length");
        of.not_negative(link.form.pull, "Pull");
        of.not_negative(link.length, "length");
        of.finite(link.sideways.direction, "sideways");
        of.not_negative(link.sideways.stiffness, "sideways stiffness");
        of.finite(link.sideways.gap, "sideways gap");
      }
    }

    void check_contact_values(const Scene &scene)
    {
      for (const SurfaceContact &contact : scene.contacts)
      {
        const Values of(contact, "contact");
        of.index(contact.slave.body, scene.bodies.size(), "bodies", "Slave");
        if (contact.obstacle.shape == ObstacleSetting::Shape::none)
          of.index(contact.master.body, scene.bodies.size(), "bodies", "Master");
        of.finite(contact.obstacle.point, "Point");
        of.finite(contact.obstacle.direction, "Direction");
        of.not_negative(contact.obstacle.radius, "Radius");
        of.finite(contact.gap, "Gap");
        of.not_negative(contact.compliance, "Compliance");
        of.not_negative(contact.search_distance, "Search distance");
      }
    }
  } // namespace

  void check_values(const Scene &scene)
  {
    if (!is_finite(scene.gravity))
      throw EntryError("Gravity", "it is not finite");
    check_wire_values(scene);
    check_mass_values(scene);
    for (const CustomBody &body : scene.bodies)
      if (!body.type)
        fail(body, "Type", "body '", body.name, "': it has no type");
    check_link_values(scene);
    check_contact_values(scene);
    for (const Load &load : scene.loads)
    {
      const Values of(load, "load");
      of.attachment(scene, load.target, "On");
      of.unit(load.direction, load.rotational ? "Axis" : "Direction");
      of.constant(load.magnitude, "Magnitude");
      of.finite(load.speed, "Speed");
    }
    for (const Probe &probe : scene.probes)
    {
      const Values of(probe, "probe");
      of.attachment(scene, probe.point, "Point");
      of.unit(probe.direction, probe.rotational ? "Axis" : "Direction");
    }
  }
} // namespace taut
