// SPDX-License-Identifier: LGPL-2.1-or-later Parts of an overhead line in space beyond a line in
// the plane: lateral motion, stagger, wind.
#include "catenary.h"

#include <string>

namespace taut
{
  Expression Catenary::WireItem::wind_load(const std::string &section) const
  {
    return Expression(wind, "Catenary/" + section + "/Wind");
  }

  bool Catenary::is_in_space() const
  {
    return lateral || contact.stagger != 0. || messenger.stagger != 0. ||
           !contact.wind_load("Contact wire").is_zero() ||
           !messenger.wind_load("Messenger wire").is_zero();
  }

  /// Supports along z at all masts, each with its own name and place.
  void Catenary::hold_aside(const std::size_t wire, const WireItem &item, const std::string &name,
                            Scene &scene) const
  {
    for (unsigned int mast = 0; mast <= n_spans; ++mast)
    {
      Support support;
      support.name = name + " " + std::to_string(mast);
      support.origin = "Catenary";
      support.wire = wire;
      support.positions = {mast * span_length};
      support.motion = WireMotion::lateral;
      support.prescribed = Expression(mast % 2 == 0 ? item.stagger : -item.stagger);
      scene.supports.push_back(support);
    }
  }

  void Catenary::add_lateral(Scene &scene) const
  {
    hold_aside(messenger_wire, messenger, "messenger aside at mast", scene);
    hold_aside(contact_wire, contact, "steady arm at mast", scene);
    const Expression loads[] = {messenger.wind_load("Messenger wire"),
                                contact.wind_load("Contact wire")};
    for (const std::size_t wire : {messenger_wire, contact_wire})
    {
      scene.wires[wire].has_lateral = true;
      if (loads[wire].is_zero())
        continue;
      Load wind;
      wind.name = "wind on " + scene.wires[wire].name;
      wind.origin = scene.wires[wire].origin;
      wind.kind = Load::Kind::distributed;
      wind.target = {Attachment::Kind::wire, wire, 0.};
      wind.direction = {0., 0., 1.};
      wind.magnitude = loads[wire];
      wind.acts_while_built = false;
      scene.loads.push_back(wind);
    }
  }
} // namespace taut
