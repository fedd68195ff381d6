// SPDX-License-Identifier: LGPL-2.1-or-later Checks of an overhead line and its pantographs beyond
// those of any scene, with messages about their entries.
#include "catenary.h"

#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/scene/entries.h>
#include <taut/scene/shared_places.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  /// Checks of an overhead line beyond those of any scene.
  void Catenary::check_line() const
  {
    if (!(span_length > 0.))
      throw EntryError("Catenary/Span length", "it must be positive");
    constexpr double longest = 1e9;
    if (!(n_spans * span_length <= longest))
      throw EntryError("Catenary/Span length", "the line would be " +
                                                   to_text(n_spans * span_length) +
                                                   " m long; at most 1e9 m are possible");
    const std::pair<const WireItem *, const char *> wires[] = {{&contact, "Contact wire"},
                                                               {&messenger, "Messenger wire"}};
    for (const auto &[wire, section] : wires)
      if (!(wire->tension > 0.))
        throw EntryError(std::string("Catenary/") + section + "/Tension",
                         "it must be positive: the wire of an overhead line hangs by its tension");

    const double length = n_spans * span_length;
    for (const double x : uplift_positions)
      if (!(x >= 0. && x <= length))
        throw EntryError("Catenary/Uplift positions", to_text(x) +
                                                          " m is outside wire 'contact', 0 to " +
                                                          to_text(length) + " m");

    droppers.check(span_length,
                   std::min(same_place(contact.wire("contact", 0., length)),
                            same_place(messenger.wire("messenger", 0., length))),
                   is_in_space());
  }

  void Catenary::check_pantographs() const
  {
    const double length = n_spans * span_length;
    for (std::size_t i = 0; i < pantographs.size(); ++i)
    {
      const PantographItem &item = pantograph_items[i];
      const std::string section = "Catenary/Pantograph " + pantographs[i];
      if (!(item.start >= 0. && item.start <= length))
        throw EntryError(section + "/Start", "the pantograph would stand outside the line, which "
                                             "reaches from 0 to " +
                                                 to_text(length) + " m");
      if (item.static_force < 0.)
        throw EntryError(section + "/Static force",
                         "it pushes the pantograph up, against the contact wire; a negative one "
                         "would keep it away from the wire. Give a force of at least 0");
      if (item.contact_damping > 0. &&
          std::isinf(parse_stiffness(item.contact_stiffness, section + "/Contact stiffness")))
        throw EntryError(section + "/Contact damping",
                         "a rigid contact has none; give it a finite Contact stiffness");
      for (std::size_t k = 0; k < i; ++k)
        if (item.start == pantograph_items[k].start && item.speed == pantograph_items[k].speed)
          throw EntryError(section + "/Start", "pantograph '" + pantographs[k] +
                                                   "' stands at the same place; give them "
                                                   "different ones");
    }
  }
} // namespace taut
