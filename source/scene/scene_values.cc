// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/scene_values.h"
#include "scene/travel.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>

#include <type_traits>

namespace taut
{
  namespace
  {
    /// Writes all members of each part of the scene.
    class Writer
    {
    public:
      explicit Writer(OutputArchive &archive) : archive(archive) {}

      template <typename... Values>
      void all(const Values &...values)
      {
        (write(values), ...);
      }

      template <typename Item>
      void list(const std::vector<Item> &items)
      {
        write(items.size());
        for (const Item &item : items)
          write(item);
      }

    private:
      template <typename Value>
      std::enable_if_t<std::is_arithmetic_v<Value>> write(const Value &value)
      {
        archive << value;
      }
      template <typename Value>
      std::enable_if_t<std::is_enum_v<Value>> write(const Value &value)
      {
        const int number = static_cast<int>(value);
        archive << number;
      }
      void write(const std::string &value) { archive << value; }
      void write(const std::vector<double> &values) { archive << values; }
      void write(const Coordinates &c) { all(c.x, c.y, c.z); }
      /// Messages name an entry in the section of the part.
      void write(const Expression &e) { all(e.content(), e.depends_on_time()); }
      void write(const InitialMotion &m) { all(m.displacement, m.velocity); }
      void write(const Attachment &a) { all(a.kind, a.index, a.position, a.place, a.has_place); }
      void write(const std::vector<TensionChange> &changes)
      {
        for (const TensionChange &c : changes)
          all(c.from, c.to, c.change);
      }
      void write(const std::shared_ptr<const Travel> &travel)
      {
        write(travel ? travel->text() : std::string());
      }
      void write(const Wire &w)
      {
        all(w.name, w.origin, w.a, w.b, w.mass_per_length, w.has_axial, w.axial_stiffness,
            w.transverse, w.has_lateral, w.tension, w.bending_stiffness, w.remaining.mass,
            w.remaining.axial_stiffness, w.remaining.bending_stiffness, w.degree, w.mass_matrix,
            w.element_size, w.damping.mass, w.damping.stiffness, w.tension_changes,
            w.foundation_stiffness, w.foundation_damping, w.weight, w.axial_start,
            w.transverse_start, w.lateral_start);
      }
      void write(const Support &s)
      {
        all(s.name, s.origin, s.wire, s.positions, s.motion, s.fixed, s.prescribed, s.stiffness,
            s.damping);
      }
      void write(const PointMass &m)
      {
        all(m.name, m.origin, m.wire, m.positions, m.mass, m.weight);
      }
      void write(const Mass &m)
      {
        all(m.name, m.origin, m.position, m.mass, m.inertia, m.weight);
        for (unsigned int i = 0; i < 4; ++i)
          all(m.moves[i], m.displacement[i], m.velocity[i], m.is_prescribed[i], m.prescribed[i]);
        all(m.speed, m.travel);
      }
      void write(const Spring &s)
      {
        all(s.name, s.origin, s.from, s.to, s.rotational, s.direction, s.stiffness, s.damping);
      }
      void write(const Link &l)
      {
        list(l.through);
        all(l.name, l.origin, l.kind, l.from, l.to, l.rotational, l.direction, l.stiffness,
            l.law ? l.law->description() : std::string(), l.damping, l.gap, l.turns,
            l.unstressed_length, l.length_in_time, l.speed, l.travel, l.strip, l.straight,
            l.profile, l.cant, l.form.find_length, l.form.prescribed_displacement,
            l.form.axial_stiffness, l.form.mass_per_length, l.form.pull, l.length,
            l.form.find_direction, l.sideways.direction, l.sideways.stiffness, l.sideways.gap,
            l.contact_mass);
      }
      void write(const Load &l)
      {
        all(l.name, l.origin, l.kind, l.target, l.rotational, l.direction, l.magnitude, l.speed,
            l.travel, l.acts_while_built);
      }
      void write(const Probe &p)
      {
        all(p.name, p.origin, p.point, p.rotational, p.direction, p.quantity);
      }

      OutputArchive &archive;
    };
  } // namespace

  std::string values_of(const Scene &scene)
  {
    if (!scene.bodies.empty())
      throw UserError("a scene with bodies from plugins has no values to compare it by");
    return archived(
        [&](OutputArchive &archive)
        {
          Writer writer(archive);
          writer.all(scene.gravity, scene.start);
          writer.list(scene.wires);
          writer.list(scene.supports);
          writer.list(scene.point_masses);
          writer.list(scene.masses);
          writer.list(scene.springs);
          writer.list(scene.links);
          writer.list(scene.loads);
          writer.list(scene.probes);
        });
  }
} // namespace taut
