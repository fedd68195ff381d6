// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/check_parts.h"
#include "scene/network.h"

#include "base/text.h"
#include "scene/entries.h"
#include "scene/travel.h"
#include <taut/base/exceptions.h>
#include <taut/scene/contact_surface.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace taut
{
  double gap_of_length(const Link &link, const Scene &scene)
  {
    return link.unstressed_length -
           dot(link.direction, place(scene, link.to) - place(scene, link.from));
  }

  namespace
  {
    bool has_axis(const Network::LinkItem &item)
    {
      return item.type == "hinge" || item.type == "universal joint";
    }

    bool is_ball_joint(const Network::LinkItem &item)
    {
      return item.type == "ball joint" || has_axis(item);
    }

    /// Throws EntryError for entries that a ball joint, hinge or universal joint does not have.
    void check_ball_joint(const Network::LinkItem &item, const std::string &title)
    {
      for (const auto &[given, entry] :
           {std::pair(!item.direction.empty(), "/Direction"),
            {!item.axis.empty() && !has_axis(item), "/Axis"},
            {item.rotational, "/Rotational"},
            {item.gap != 0., "/Gap"},
            {item.stiffness != "rigid" && has_axis(item), "/Stiffness"}})
        if (given)
          throw EntryError(title + entry,
                           "a " + item.type +
                               " holds one place to another along x, y and z, and has none; leave "
                               "it out, or take a joint");
    }

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

    /// The end of a rod that an axis of a joint is the arm of. With arms of sqrt(2) m, at a right
    /// angle, the force of the rod in N is the moment about the normal of both in N m.
    Attachment arm(Attachment end, const Attachment &other, const Coordinates &axis)
    {
      if (end.kind == Attachment::Kind::ground && !end.has_place)
        end.place = other.place;
      end.has_place = true;
      end.place = add_scaled(end.place, std::sqrt(2.), axis);
      return end;
    }

    /// The rows of a hinge or universal joint beside those of its ball joint: rods from the axis of
    /// one body to what is across it on the other one. Lengths of rods are products of vectors of
    /// both bodies, so that they hold however far the bodies turn. They are those of ends at one
    /// place, to which a start brings them.
    void add_axes(const Network::LinkItem &item, const Link &all, Scene &scene)
    {
      const auto axis_of = [&](const std::vector<double> &axis, const char *const entry) {
        return axis.empty() ? Coordinates{0., 0., 1.} : parse_direction(axis, all.origin + entry);
      };
      const Coordinates axis = axis_of(item.axis, "/Axis");
      std::vector<Coordinates> across;
      if (item.type == "hinge")
      {
        const Coordinates other =
            std::fabs(axis.x) < .6 ? Coordinates{1., 0., 0.} : Coordinates{0., 1., 0.};
        across.push_back(unit(cross(axis, other), all.origin + "/Axis"));
        across.push_back(cross(axis, across[0]));
      }
      else
      {
        /// Cosine of an angle that counts as a right one, of numbers with five digits.
        constexpr double right_angle = 1e-5;
        across.push_back(axis_of(item.second_axis, "/Second axis"));
        if (!(std::fabs(dot(axis, across[0])) <= right_angle))
          throw EntryError(all.origin + "/Second axis",
                           to_text("it is at a cosine of ", dot(axis, across[0]),
                                   " to Axis; those of a universal joint are at a right angle"));
      }
      for (const auto &[end, entry] : {std::pair(&all.from, "/From"), {&all.to, "/To"}})
        if (end->kind != Attachment::Kind::ground &&
            !(end->kind == Attachment::Kind::body &&
              scene.bodies[end->index].type_name == "rigid body"))
          throw EntryError(all.origin + entry, "a " + item.type +
                                                   " is between rigid bodies, or a rigid body and "
                                                   "the ground; take a ball joint");
      for (std::size_t k = 0; k < across.size(); ++k)
      {
        Link rod = all;
        rod.name += " across" + (across.size() > 1 ? " " + std::to_string(k + 1) : "");
        rod.from = arm(all.from, all.to, axis);
        rod.to = arm(all.to, all.from, across[k]);
        rod.turns = true;
        rod.unstressed_length = std::sqrt(2.) * norm(across[k] - axis);
        scene.links.push_back(rod);
      }
    }

    /// Checks entries of links that turn, and entries that only links that turn may have.
    void check_turns(const Network::LinkItem &item, const Link &link, const std::string &title)
    {
      if (link.unstressed_length > 0. && link.gap != 0.)
        throw EntryError(title + "/Gap", "it follows from the Length; leave one of them out");
      if (!link.turns)
      {
        if (link.unstressed_length > 0. &&
            (link.kind != LinkKind::dropper || link.rotational || item.find_length))
          throw EntryError(title + "/Length",
                           "it is of a dropper, or of a link that turns; set 'Turns = true', or "
                           "give the Gap");
        return;
      }
      if (is_ball_joint(item) || link.moving())
        throw EntryError(
            title + "/Turns",
            "a " + item.type +
                " has no direction from end to end; take a joint, a stop or a dropper");
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
    }

    /// Sets the gap of a dropper with a given length, whose direction and ends are set.
    void set_length(const Scene &scene, const std::string &title, Link &link)
    {
      if (!(link.unstressed_length > 0.) || link.turns)
        return;
      for (const Attachment *const end : {&link.from, &link.to})
        if (end->kind == Attachment::Kind::body ||
            (end->kind == Attachment::Kind::ground && !end->has_place))
          throw EntryError(title + "/Length",
                           "the distance of its ends is known between wires, masses and places of "
                           "the ground, 'ground @ x, y, z'; give the Gap instead");
      link.length = link.unstressed_length;
      link.gap = gap_of_length(link, scene);
    }

    void check_found_direction(const Scene &scene, const std::string &title, const Link &link)
    {
      if (!link.form.find_direction)
        return;
      if (link.turns || (!link.form.find_length && !(link.unstressed_length > 0.)))
        throw EntryError(title + "/Find direction",
                         "it is found with the length, or of a dropper of a known length that does "
                         "not turn; set 'Find length = true', give a Length, or give the Direction "
                         "from end to end alone");
      for (const Attachment *const end : {&link.from, &link.to})
        if (end->kind != Attachment::Kind::wire || !scene.wires[end->index].has_lateral ||
            scene.wires[end->index].has_axial)
          throw EntryError(title + "/Find direction",
                           "it is of a dropper between wires with the component lateral and "
                           "without bar; set it to false");
    }

    /// Numbers with ':' or ';' between them.
    bool are_numbers(std::string text)
    {
      std::replace(text.begin(), text.end(), ';', ':');
      const std::vector<std::string> parts = split(text, ':');
      return std::all_of(parts.begin(), parts.end(),
                         [](const std::string &part)
                         {
                           char *end = nullptr;
                           std::strtod(part.c_str(), &end);
                           return !part.empty() && *end == '\0';
                         });
    }

    /// The rings of a rope: names, each with its place if there is one, whose numbers have commas
    /// between them, too.
    std::vector<Attachment> parse_rings(const std::string &text, const Scene &scene,
                                        const std::string &entry)
    {
      std::vector<std::string> names;
      for (const std::string &part : text.empty() ? names : split(text, ','))
      {
        const bool may_go_on =
            !names.empty() && names.back().find('@') != std::string::npos && are_numbers(part);
        if (may_go_on && find_name(scene.masses, part) != ground)
          throw EntryError(entry, "'" + part + "' is a mass and may be a number of the place '" +
                                      names.back() + "', too; give the mass another name");
        if (may_go_on)
          names.back() += ", " + part;
        else
          names.push_back(part);
      }
      std::vector<Attachment> rings;
      for (const std::string &name : names)
        for (const Attachment &ring : parse_attachments(name, scene, entry))
          rings.push_back(ring);
      return rings;
    }

    /// Throws EntryError for ends between which no such link is possible.
    void check_ends(const Link &link, const Scene &scene, const std::string &title,
                    const bool has_direction)
    {
      if (link.straight && !(link.moving() && is_on_cable(scene, link.to)))
        throw EntryError(title + "/Straight", "it is of a sliding contact on a cable, whose length "
                                              "is not that of its way; set it to false");
      if (link.from.kind == Attachment::Kind::body && link.to.kind == link.from.kind &&
          link.from.index == link.to.index && link.from.place == link.to.place &&
          link.through.empty())
        throw EntryError(title + "/To",
                         "it is the place that From is; a link is between two places");
      if (!has_direction && !link.rotational &&
          (is_on_cable(scene, link.from) || is_on_cable(scene, link.to)))
        throw EntryError(
            title + "/Direction",
            "give 'x, y' or 'x, y, z', or set 'Turns = true': places on a cable are counted along "
            "it, so that no straight line between the ends is known before its shape");
    }

    void set_law(const Network::LinkItem &item, const std::string &title, Link &link)
    {
      link.stiffness = parse_stiffness(item.stiffness, title + "/Stiffness");
      link.law = parse_law(item.law, item.law_points, item.law_formula, item.law_range, title);
      if (!link.law)
        return;
      if (!link.unilateral())
        throw EntryError(title + "/Law",
                         "a law is for links that only push or pull; give a joint a Stiffness");
      if (!link.rigid() || item.axial_stiffness > 0.)
        throw EntryError(
            title + "/Law",
            "it is the law of the force; leave Stiffness 'rigid' and Axial stiffness 0");
      link.stiffness = link.law->largest_stiffness();
    }

    /// A number, or for a link that turns a formula or table of t.
    void set_unstressed_length(const std::string &text, const std::string &title, Link &link)
    {
      const std::string entry = title + "/Length";
      const Expression length(text, entry, Expression::Variables::time);
      link.unstressed_length = length(0., 0.);
      if (!(link.unstressed_length >= 0.))
        throw EntryError(entry, to_text("it is ", link.unstressed_length,
                                        " m at the start; give a length that is not negative"));
      if (!length.depends_on_time())
        return;
      if (!link.turns)
        throw EntryError(entry, "a length that changes with time is that of a link that turns; set "
                                "'Turns = true', or give a number");
      if (link.unstressed_length == 0.)
        throw EntryError(entry, "it is 0 at the start, which would stand for the Gap; give a "
                                "positive length");
      link.length_in_time = length;
    }

    /// The link of an item, without its ends and what follows from them.
    Link link_without_ends(const Network::LinkItem &item, const std::string &title)
    {
      Link link;
      link.origin = title;
      link.kind = item.type == "stop"              ? LinkKind::stop
                  : item.type == "dropper"         ? LinkKind::dropper
                  : item.type == "sliding contact" ? LinkKind::sliding_contact
                                                   : LinkKind::joint;
      if (is_ball_joint(item))
        check_ball_joint(item, title);
      if (!item.second_axis.empty() && item.type != "universal joint")
        throw EntryError(title + "/Second axis",
                         "it is of a universal joint; leave it out, or take that");
      link.rotational = item.rotational;
      set_law(item, title, link);
      link.damping = item.damping;
      link.gap = item.gap;
      link.turns = item.turns;
      set_unstressed_length(item.length, title, link);
      check_turns(item, link, title);
      const Speed speed = parse_speed(item.speed, title + "/Speed");
      link.speed = speed.constant;
      link.travel = speed.travel;
      link.faster_than_waves = item.faster_than_waves;
      link.straight = item.straight;
      link.profile =
          Expression(item.profile, title + "/Height profile", Expression::Variables::position);
      link.form.find_length = item.find_length;
      link.form.prescribed_displacement = item.prescribed_displacement;
      link.form.axial_stiffness = item.axial_stiffness;
      link.form.mass_per_length = item.mass_per_length;
      link.form.pull = item.pull;
      link.form.find_direction = item.find_direction;
      return link;
    }

    /// Sets the direction of a link whose ends are set, as far as it has one before the run.
    void set_direction(const Network::LinkItem &item, const Scene &scene, const std::string &title,
                       Link &link)
    {
      if (item.rotational || !item.axis.empty() || !item.direction.empty())
      {
        link.direction = parse_direction_or_axis(item.rotational, item.direction, item.axis, title);
        return;
      }
      const auto has_place = [](const Attachment &end)
      { return end.kind != Attachment::Kind::ground || end.has_place; };
      if (link.turns)
      {
        for (const auto &[end, entry] : {std::pair(&link.from, "/From"), {&link.to, "/To"}})
          if (!has_place(*end))
            throw EntryError(title + entry, "a link that turns needs the place of its end at the "
                                            "ground; write 'ground @ x, y, z'");
        return;
      }
      if (!has_place(link.from) || !has_place(link.to))
        throw EntryError(title + "/Direction",
                         "give 'x, y' or 'x, y, z', or a place of the ground, 'ground @ x, y, z'");
      link.direction = unit(place(scene, link.to) - place(scene, link.from), title + "/Direction");
    }
  } // namespace

  namespace
  {
    /// The wires that `To` of a sliding contact lists, each as "wire" or "wire @ start"; empty if
    /// it is no such list.
    std::vector<std::string> wires_of_strip(const Network::LinkItem &item, const Scene &scene)
    {
      const std::vector<std::string> parts = split(item.to, ',');
      const bool are_wires = std::all_of(
          parts.begin(), parts.end(),
          [&](const std::string &part)
          { return find_name(scene.wires, trim(part.substr(0, part.find('@')))) != ground; });
      return item.type == "sliding contact" && parts.size() > 1 && are_wires
                 ? parts
                 : std::vector<std::string>();
    }

    /// A link to each wire over a strip, which moves along all wires with the Speed, in the
    /// direction of the first one. Without a start of its own it is below `From` along the wire,
    /// also before its begin.
    void add_strip(Link link, const std::vector<std::string> &wires, const std::string &speed,
                   Scene &scene)
    {
      const std::string first_name = link.name;
      constexpr double least_along = .5; // cosine of an angle from which on wires cross
      std::optional<Coordinates> way;
      if (link.strip.empty())
        link.strip = link.name;
      for (const std::string &text : wires)
      {
        const std::size_t at = text.find('@');
        const std::string name = trim(text.substr(0, at));
        const std::size_t index = find_name(scene.wires, name);
        const Wire &wire = scene.wires[index];
        link.name = first_name + " on " + name;
        way = way.value_or(wire.tangent());
        const double along = dot(wire.tangent(), *way);
        if (!(std::fabs(along) > least_along))
          throw EntryError(link.origin + "/To", "wire '" + name +
                                                    "' is across the first one, along which the "
                                                    "strip moves; leave it out");
        const Speed of_wire = parse_speed(speed, link.origin + "/Speed", std::copysign(1., along));
        link.speed = of_wire.constant;
        link.travel = of_wire.travel;
        link.to = {Attachment::Kind::wire, index,
                   dot(place(scene, link.from) - wire.a, wire.tangent())};
        if (at != std::string::npos)
        {
          const std::vector<double> start =
              parse_positions(text.substr(at + 1), link.origin + "/To");
          if (start.size() != 1)
            throw EntryError(link.origin + "/To", "a strip has one start on each wire");
          link.to.position = start[0];
        }
        scene.links.push_back(link);
      }
    }
  } // namespace

  void Network::add_links(Scene &scene) const
  {
    for (std::size_t i = 0; i < links.items.size(); ++i)
    {
      const LinkItem &item = links.items[i];
      const std::string title = links.title(i);
      Link link = link_without_ends(item, title);
      const auto from = parse_attachments(item.from, scene, title + "/From");
      link.through = parse_rings(item.through, scene, title + "/Through");
      link.strip = item.strip;
      if (!link.strip.empty() && !link.moving())
        throw EntryError(title + "/Strip", "it is of a sliding contact; leave it empty");
      if (const auto wires = wires_of_strip(item, scene); !wires.empty())
      {
        if (from.size() != 1 || from[0].kind != Attachment::Kind::mass)
          throw EntryError(title + "/From", "the strip that slides along several wires is a mass");
        if (item.direction.empty())
          throw EntryError(title + "/Direction",
                           "give that in which the strip pushes, e.g. '0, 1'");
        link.name = links.names[i];
        link.from = from[0];
        link.direction = parse_direction_or_axis(item.rotational, item.direction, item.axis, title);
        add_strip(link, wires, item.speed, scene);
        continue;
      }
      const auto to = parse_attachments(item.to, scene, title + "/To");
      if (from.size() != to.size() && from.size() != 1 && to.size() != 1)
        throw EntryError(title, "From has " + std::to_string(from.size()) + " positions and To " +
                                    std::to_string(to.size()) +
                                    "; give equal numbers, or one of one");
      const std::size_t n = std::max(from.size(), to.size());
      if (!link.through.empty() && n > 1)
        throw EntryError(title + "/Through",
                         "a rope through rings has one end at From and one at To");
      for (std::size_t k = 0; k < n; ++k)
      {
        link.name = links.names[i] + (n > 1 ? " " + std::to_string(k + 1) : "");
        link.from = from[from.size() > 1 ? k : 0];
        link.to = to[to.size() > 1 ? k : 0];
        if (link.moving() && link.to.kind == Attachment::Kind::body)
          link.to.position = link.to.place.x;
        check_ends(link, scene, title,
                   !item.direction.empty() || is_ball_joint(item) || link.turns);
        if (is_ball_joint(item))
        {
          add_ball_joint(link, scene);
          if (has_axis(item))
            add_axes(item, link, scene);
          continue;
        }
        set_direction(item, scene, title, link);
        set_length(scene, title, link);
        check_found_direction(scene, title, link);
        scene.links.push_back(link);
      }
    }
  }
} // namespace taut
