// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/entries.h"
#include "base/nearest_name.h"
#include "base/text.h"
#include "scene/places_by_x.h"
#include <taut/base/exceptions.h>

#include <cmath>
#include <limits>

namespace taut
{
  double parse_number(const std::string &text, const std::string &entry)
  {
    std::size_t used = 0;
    double value = 0.;
    try
    {
      value = std::stod(text, &used);
    }
    catch (const std::exception &)
    {
      used = 0;
    }
    if (used == 0 || used != text.size() || !std::isfinite(value))
      throw EntryError(entry, "'" + text + "' is not a finite number");
    return value;
  }

  namespace
  {
    /// Attachments at points of a body or of the ground, "0.1, 0.2; 0.3, 0.2".
    std::vector<Attachment> on_body(Attachment attachment, const std::string &points,
                                    const std::string &entry, const bool is_cable)
    {
      std::vector<Attachment> attachments;
      for (const std::string &point : split(points, ';'))
      {
        std::vector<double> components;
        for (const std::string &component : split(point, ','))
          components.push_back(parse_number(component, entry));
        attachment.place = parse_coordinates(components, entry);
        if (is_cable && (attachment.place.y != 0. || attachment.place.z != 0.))
          throw EntryError(entry, "'" + point +
                                      "' is no place on a cable: write its unstressed arc length "
                                      "and a zero, 's, 0', or "
                                      "'x = ...'");
        attachments.push_back(attachment);
      }
      if (attachments.empty())
        throw EntryError(entry, "no point after '@'; write 'x, y' or 'x, y, z'");
      return attachments;
    }

    /// The x of "x = 12.5" or "x = 10:5:30"; empty for other texts.
    std::string text_of_x(const std::string &points)
    {
      const std::size_t equals = points.find('=');
      return equals != std::string::npos && trim(points.substr(0, equals)) == "x"
                 ? trim(points.substr(equals + 1))
                 : "";
    }
  } // namespace

  std::vector<double> parse_positions(const std::string &text, const std::string &entry)
  {
    constexpr double most = 1e6;
    std::vector<double> positions;
    for (const std::string &part : split(text, ','))
    {
      const std::vector<std::string> range = split(part, ':');
      if (range.size() == 1)
        positions.push_back(parse_number(range[0], entry));
      else if (range.size() == 3)
      {
        const double first = parse_number(range[0], entry), step = parse_number(range[1], entry),
                     last = parse_number(range[2], entry);
        if (!(step > 0.) || last < first || (last - first) / step > most)
          throw EntryError(entry,
                           "the range '" + part +
                               "' is empty or endless; write first:step:last with a positive step");
        const auto n = static_cast<long>(std::floor((last - first) / step * (1. + 1e-12) + 1e-9));
        for (long k = 0; k <= n; ++k)
          positions.push_back(first + k * step);
      }
      else
        throw EntryError(entry, "'" + part + "' is neither a number nor a range first:step:last");
    }
    return positions;
  }

  double parse_stiffness(const std::string &text, const std::string &entry)
  {
    if (trim(text) == "rigid")
      return std::numeric_limits<double>::infinity();
    const std::string allowed = "a stiffness is a positive number or 'rigid'";
    double value = 0.;
    try
    {
      value = parse_number(trim(text), entry);
    }
    catch (const EntryError &e)
    {
      throw EntryError(entry, e.message() + "; " + allowed);
    }
    if (!(value > 0.))
      throw EntryError(entry, allowed + "; got '" + text + "'");
    return value;
  }

  Expression remaining_share(const std::string &formula, const std::string &entry)
  {
    const Expression share(formula, entry, Expression::Variables::position);
    if (!share.is_constant())
      return share;
    if (!(share(0., 0.) > 0.))
      throw EntryError(entry, "'" + formula +
                                  "' is not positive; give the share that is left, 1 for a wire as "
                                  "new");
    return share(0., 0.) == 1. ? Expression() : share;
  }

  Coordinates parse_coordinates(const std::vector<double> &components, const std::string &entry)
  {
    if (components.size() != 2 && components.size() != 3)
      throw EntryError(entry, "give two numbers 'x, y', or three 'x, y, z'");
    return {components[0], components[1], components.size() == 3 ? components[2] : 0.};
  }

  Coordinates unit(const Coordinates &direction, const std::string &entry)
  {
    const double length = norm(direction);
    if (!(length > 0.) || !std::isfinite(length))
      throw EntryError(entry, "a direction is not zero");
    return {direction.x / length, direction.y / length, direction.z / length};
  }

  Coordinates parse_direction(const std::vector<double> &components, const std::string &entry)
  {
    return unit(parse_coordinates(components, entry), entry);
  }

  Coordinates parse_direction_or_axis(const bool rotational, const std::vector<double> &direction,
                                      const std::vector<double> &axis, const std::string &section)
  {
    if (!rotational && !axis.empty())
      throw EntryError(section + "/Axis",
                       "it is that of a rotation; set 'Rotational = true', or give a Direction");
    if (rotational && !direction.empty())
      throw EntryError(
          section + "/Direction",
          "what is rotational turns about an Axis, z if it has none; leave the Direction empty");
    if (!rotational)
      return direction.empty() ? Coordinates{0., 1.}
                               : parse_direction(direction, section + "/Direction");
    return axis.empty() ? Coordinates{0., 0., 1.} : parse_direction(axis, section + "/Axis");
  }

  namespace
  {
    /// Attachments at positions on a wire, "1, 3:2:9".
    std::vector<Attachment> on_wire(Attachment attachment, const std::string &positions,
                                    const std::string &entry)
    {
      std::vector<Attachment> attachments;
      for (const double s : parse_positions(positions, entry))
      {
        attachment.position = s;
        attachments.push_back(attachment);
      }
      if (attachments.empty())
        throw EntryError(entry, "no position after '@'");
      return attachments;
    }

    /// Attachments at places of a body that are named by their x.
    std::vector<Attachment> at_x(Attachment attachment, const std::string &x, const Scene &scene,
                                 const std::string &entry)
    {
      const CustomBody &body = scene.bodies[attachment.index];
      const auto *const type = dynamic_cast<const PlacesByX *>(body.type.get());
      if (type == nullptr)
        throw EntryError(entry, "'x = " + x + "' is of places on a cable; body '" + body.name +
                                    "' is none: write 'x, y' or 'x, y, z'");
      std::vector<Attachment> attachments;
      try
      {
        for (const double s :
             type->places_at(parse_positions(x, entry), {body.name, body.origin, scene.gravity}))
        {
          attachment.place = {s};
          attachments.push_back(attachment);
        }
      }
      catch (const EntryError &)
      {
        throw; // about the body
      }
      catch (const UserError &e)
      {
        throw EntryError(entry, e.what());
      }
      return attachments;
    }

    /// Throws an EntryError with names that attachments may have, the nearest one first.
    [[noreturn]] void refuse_unknown(const std::string &text, const std::string &name,
                                     const Scene &scene, const std::string &entry)
    {
      constexpr std::size_t most = 12;
      std::vector<std::string> names = {"ground"};
      std::string known = "ground, ground @ x, y";
      const auto add = [&](const auto &parts, const std::string &place)
      {
        for (const auto &part : parts)
        {
          if (names.size() < most)
            known += ", " + part.name + place;
          names.push_back(part.name);
        }
      };
      add(scene.bodies, " @ x, y");
      add(scene.masses, "");
      add(scene.wires, " @ position");
      if (names.size() > most)
        known += " and " + std::to_string(names.size() - most) + " more";
      if (name.empty())
        throw EntryError(entry, "it says not where; write one of: " + known);
      const std::string near = nearest_name(name, names);
      throw EntryError(entry, "'" + text + "' is not known; " +
                                  (near.empty() ? "" : "did you mean '" + near + "'? ") +
                                  "Known are: " + known);
    }
  } // namespace

  std::vector<Attachment> parse_attachments(const std::string &text, const Scene &scene,
                                            const std::string &entry)
  {
    const std::size_t at = text.find('@');
    const std::string name = trim(text.substr(0, at));
    Attachment attachment;
    if (at == std::string::npos)
    {
      if (name == "ground")
        return {attachment};
      attachment.kind = Attachment::Kind::mass;
      attachment.index = find_name(scene.masses, name);
      if (attachment.index != ground)
        return {attachment};
      if (find_name(scene.wires, name) != ground)
        throw EntryError(entry, "say where on the wire: '" + name + " @ position'");
      if (find_name(scene.bodies, name) != ground)
        throw EntryError(entry, "say where on the body: '" + name + " @ x, y' or '" + name +
                                    " @ x, y, z'");
    }
    else
    {
      if (name == "ground")
      {
        attachment.has_place = true;
        return on_body(attachment, text.substr(at + 1), entry, false);
      }
      attachment.kind = Attachment::Kind::wire;
      attachment.index = find_name(scene.wires, name);
      if (attachment.index != ground)
        return on_wire(attachment, text.substr(at + 1), entry);
      attachment.kind = Attachment::Kind::mass;
      attachment.index = find_name(scene.masses, name);
      if (attachment.index != ground)
        return on_body(attachment, text.substr(at + 1), entry, false);
      attachment.kind = Attachment::Kind::body;
      attachment.index = find_name(scene.bodies, name);
      if (attachment.index != ground)
      {
        if (const std::string x = text_of_x(text.substr(at + 1)); !x.empty())
          return at_x(attachment, x, scene, entry);
        return on_body(attachment, text.substr(at + 1), entry, is_on_cable(scene, attachment));
      }
    }
    refuse_unknown(text, name, scene, entry);
  }

  bool is_on_cable(const Scene &scene, const Attachment &point)
  {
    return point.kind == Attachment::Kind::body && scene.bodies[point.index].type_name == "cable";
  }

  Coordinates place(const Scene &scene, const Attachment &point)
  {
    switch (point.kind)
    {
    case Attachment::Kind::wire:
      return scene.wires[point.index].at(point.position);
    case Attachment::Kind::body:
    case Attachment::Kind::ground:
      return point.place;
    default:
      return add_scaled(scene.masses[point.index].position, 1., point.place);
    }
  }
} // namespace taut
