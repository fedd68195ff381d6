// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/scene_report.h"
#include "base/text.h"
#include "scene/entries.h"
#include "scene/travel.h"
#include <taut/cable/cable.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Lines of cells, printed in columns.
    class Table
    {
    public:
      explicit Table(std::vector<std::string> header) { lines.push_back(std::move(header)); }

      template <typename... Cells>
      void add(const Cells &...cells)
      {
        lines.push_back({to_text(cells)...});
      }

      void print(const std::string &title, std::ostream &out) const
      {
        if (lines.size() < 2)
          return;
        std::vector<std::size_t> width(lines[0].size(), 0);
        for (const auto &line : lines)
          for (std::size_t c = 0; c < line.size(); ++c)
            width[c] = std::max(width[c], line[c].size());
        out << title << " (" << lines.size() - 1 << ")\n";
        for (const auto &line : lines)
        {
          std::string row = " ";
          for (std::size_t c = 0; c < line.size(); ++c)
            row += " " + line[c] + std::string(width[c] - line[c].size() + 1, ' ');
          out << row.substr(0, row.find_last_not_of(' ') + 1) << '\n';
        }
      }

    private:
      std::vector<std::vector<std::string>> lines;
    };

    std::string text(const Coordinates &p)
    {
      return p.z == 0. ? to_text(p.x, ", ", p.y) : to_text(p);
    }

    std::string text(const Scene &scene, const Attachment &end, const Coordinates &in_space)
    {
      if (is_on_cable(scene, end))
      {
        const double rounding = 1e-12 * norm(in_space); // of a place along a shape
        const auto cleaned = [&](const double x) { return std::fabs(x) <= rounding ? 0. : x; };
        const Coordinates at = {cleaned(in_space.x), cleaned(in_space.y), cleaned(in_space.z)};
        return to_text(scene.bodies[end.index].name, " @ ", end.place.x, " (at ", text(at), ')');
      }
      if (end.kind == Attachment::Kind::ground)
        return end.has_place ? "ground @ " + text(end.place) : "ground";
      if (end.kind == Attachment::Kind::mass)
        return scene.masses[end.index].name +
               (end.place == Coordinates() ? std::string() : " @ " + text(end.place));
      if (end.kind == Attachment::Kind::body)
        return scene.bodies[end.index].name + " @ " + text(end.place);
      return to_text(scene.wires[end.index].name, " @ ", end.position);
    }

    std::string positions(const std::vector<double> &list)
    {
      std::ostringstream out;
      for (std::size_t i = 0; i < list.size() && i < 6; ++i)
        out << (i > 0 ? ", " : "") << list[i];
      if (list.size() > 6)
        out << ", ... (" << list.size() << ")";
      return out.str();
    }

    std::string components(const Wire &wire)
    {
      std::string list = wire.has_axial ? "bar" : "";
      if (wire.transverse != TransverseKind::none)
        list += (list.empty() ? "" : ", ") +
                std::string(wire.transverse == TransverseKind::beam ? "beam" : "string");
      return list + (wire.has_lateral ? ", lateral" : "");
    }

    std::string direction(const bool rotational, const Coordinates &n)
    {
      return (rotational ? "about " : "") + text(n);
    }

    void print_bodies(const Scene &scene, std::ostream &out)
    {
      Table wires({"name", "from [m]", "to [m]", "components", "kg/m", "T [N]", "EA [N]",
                   "EI [N m^2]", "elements"});
      for (std::size_t i = 0; i < scene.wires.size(); ++i)
      {
        const Wire &w = scene.wires[i];
        wires.add(w.name, text(w.a), text(w.b), components(w), w.mass_per_length, w.tension,
                  w.axial_stiffness, w.bending_stiffness,
                  static_cast<double>(grid(scene, i).size() - 1));
      }
      wires.print("Wires", out);

      const char *motions[] = {"axial", "transverse", "slope", "lateral", "lateral slope"};
      Table supports({"name", "wire", "s [m]", "motion", "held by"});
      for (const Support &s : scene.supports)
      {
        std::ostringstream held;
        if (s.fixed)
          held << "u(t) = " << s.prescribed.formula();
        else
        {
          held << s.stiffness << " N/m, " << s.damping << " N s/m";
          if (!s.prescribed.is_zero())
            held << ", free of force at u = " << s.prescribed.formula();
        }
        supports.add(s.name, scene.wires[s.wire].name, positions(s.positions),
                     motions[static_cast<int>(s.motion)], held.str());
      }
      supports.print("Supports", out);

      Table point_masses({"name", "wire", "s [m]", "kg each", "weight"});
      for (const PointMass &m : scene.point_masses)
        point_masses.add(m.name, scene.wires[m.wire].name, positions(m.positions), m.mass,
                         m.weight ? "yes" : "no");
      point_masses.print("Point masses", out);

      Table masses({"name", "at [m]", "motions", "kg", "kg m^2", "weight"});
      for (const Mass &m : scene.masses)
        masses.add(m.name, text(m.position),
                   std::string(m.moves[0] ? "x " : "") + (m.moves[1] ? "y " : "") +
                       (m.moves[2] ? "rotation " : "") + (m.moves[3] ? "z" : ""),
                   m.mass, m.inertia, m.weight ? "yes" : "no");
      masses.print("Masses", out);

      Table bodies({"name", "type"});
      for (const CustomBody &b : scene.bodies)
        bodies.add(b.name, b.type_name);
      bodies.print("Bodies", out);

      Table springs({"name", "from", "to", "direction", "N/m", "N s/m"});
      const auto end = [&](const std::size_t i)
      { return i == ground ? std::string("ground") : scene.masses[i].name; };
      for (const Spring &s : scene.springs)
        springs.add(s.name, end(s.from), end(s.to), direction(s.rotational, s.direction),
                    s.stiffness, s.damping);
      springs.print("Springs", out);
    }
  } // namespace

  ScenePlaces places_in_space(const Scene &scene, const SceneBodies &bodies,
                              const BodyVectors *const U)
  {
    constexpr unsigned int n_pieces = 32; ///< in the line of a cable
    ScenePlaces places;
    const auto position = [&](const Attachment &point)
    {
      const Coordinates start = bodies.position(scene, point);
      if (!U || !is_on_cable(scene, point))
        return start;
      std::vector<double> moved;
      for (const Coordinates &axis :
           {Coordinates{1.}, Coordinates{0., 1.}, Coordinates{0., 0., 1.}})
      {
        std::vector<Term> terms;
        bodies.motion(point, false, axis, 1., terms);
        moved.push_back(evaluate(terms, *U));
      }
      bodies.communicator().sum(moved);
      return add_scaled(start, 1., {moved[0], moved[1], moved[2]});
    };
    for (const Link &link : scene.links)
    {
      places.links.emplace_back();
      Link::visit_places(link, [&](const Attachment &at)
                         { places.links.back().push_back(position(at)); });
    }
    for (const Load &load : scene.loads)
      places.loads.push_back(position(load.target));
    for (const Probe &probe : scene.probes)
      places.probes.push_back(position(probe.point));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    {
      places.cables.emplace_back();
      if (scene.bodies[i].type_name != "cable")
        continue;
      std::vector<double> numbers(3 * (n_pieces + 1), 0.);
      const std::size_t k = bodies.indices_of_body(i)[0];
      if (k != Structure::elsewhere)
        for (unsigned int j = 0; j <= n_pieces; ++j)
        {
          const auto &cable = dynamic_cast<const Cable &>(bodies[k]);
          const Coordinates place = {cable.elements().length() * j / n_pieces};
          Coordinates at = cable.position(place);
          if (U)
            at = {at.x + cable.displacement(place, {1.}).dot((*U)[k]),
                  at.y + cable.displacement(place, {0., 1.}).dot((*U)[k]),
                  at.z + cable.displacement(place, {0., 0., 1.}).dot((*U)[k])};
          for (unsigned int c = 0; c < 3; ++c)
            numbers[3 * j + c] = at[c];
        }
      bodies.communicator().sum(numbers);
      for (unsigned int j = 0; j <= n_pieces; ++j)
        places.cables.back().push_back({numbers[3 * j], numbers[3 * j + 1], numbers[3 * j + 2]});
    }
    return places;
  }

  namespace
  {
    /// Of a link or a load.
    template <typename Item>
    std::string speed_text(const Item &item)
    {
      return item.travel ? item.travel->text() : to_text(item.speed);
    }
  } // namespace

  void print_scene(const Scene &scene, const ScenePlaces &places, std::ostream &out)
  {
    print_bodies(scene, out);

    const char *kinds[] = {"joint", "stop", "dropper", "sliding contact"};
    Table links({"name", "type", "from", "to", "direction", "stiffness [N/m]", "gap [m]",
                 "length [m]", "speed [m/s]"});
    for (std::size_t i = 0; i < scene.links.size(); ++i)
    {
      const Link &l = scene.links[i];
      const std::string stiffness = l.law       ? l.law->description()
                                    : l.rigid() ? "rigid"
                                                : to_text(l.stiffness);
      const std::vector<Coordinates> &of = places.links[i];
      std::string to = text(scene, l.to, of.back());
      for (std::size_t k = 0; k < l.through.size(); ++k)
        to += (k == 0 ? " through " : ", ") + text(scene, l.through[k], of[k + 1]);
      links.add(l.name, kinds[static_cast<int>(l.kind)], text(scene, l.from, of.front()), to,
                l.turns ? "turns" : direction(l.rotational, l.direction), stiffness, l.gap,
                l.unstressed_length, speed_text(l));
    }
    links.print("Links", out);

    const char *load_kinds[] = {"point", "distributed", "moving"};
    Table loads({"name", "type", "on", "direction", "magnitude", "speed [m/s]"});
    for (std::size_t i = 0; i < scene.loads.size(); ++i)
    {
      const Load &l = scene.loads[i];
      loads.add(l.name, load_kinds[static_cast<int>(l.kind)],
                text(scene, l.target, places.loads[i]), direction(l.rotational, l.direction),
                l.magnitude.formula(), speed_text(l));
    }
    loads.print("Loads", out);

    Table probes({"name", "point", "direction"});
    for (std::size_t i = 0; i < scene.probes.size(); ++i)
    {
      const Probe &p = scene.probes[i];
      probes.add(p.name, text(scene, p.point, places.probes[i]),
                 direction(p.rotational, p.direction));
    }
    probes.print("Probes", out);
    out << "Gravity " << text(scene.gravity) << " m/s^2\n";
  }
} // namespace taut
