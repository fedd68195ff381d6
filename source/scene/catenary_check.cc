// SPDX-License-Identifier: LGPL-2.1-or-later Checks of an overhead line and its pantographs beyond
// those of any scene, with messages about their entries.
#include "scene/catenary.h"

#include "base/nearest_name.h"
#include "base/text.h"
#include "scene/entries.h"
#include "scene/travel.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace taut
{
  namespace
  {
    /// The ends of the line, first and last x.
    std::pair<double, double> reach(const std::vector<TensionLength> &line)
    {
      std::pair<double, double> ends(line.front().begin(), line.front().end());
      for (const TensionLength &part : line)
        ends = {std::min(ends.first, part.begin()), std::max(ends.second, part.end())};
      return ends;
    }
  } // namespace

  bool Catenary::is_in_space(const std::vector<LineItems> &of_parts) const
  {
    if (std::all_of(of_parts.begin(), of_parts.end(),
                    [](const LineItems &own) { return own.is_rail; }))
      return false;
    const std::vector<LineLayout> parts = layouts();
    const bool has_stagger =
        std::any_of(parts.begin(), parts.end(),
                    [](const LineLayout &part)
                    {
                      return std::any_of(part.masts.begin(), part.masts.end(),
                                         [](const LineMast &mast) {
                                           return mast.contact_z != 0. || mast.messenger_z != 0.;
                                         });
                    });
    return items.lateral || has_stagger || !items.track_curvature().is_zero() ||
           !items.track_cant().is_zero() || items.supports.has_rigid_arms() ||
           !items.contact.wind_load("Contact wire").is_zero() ||
           !items.messenger.wind_load("Messenger wire").is_zero();
  }

  /// One of each kind for each tension length.
  std::vector<std::string> Catenary::warnings() const
  {
    // Twice and more of what overhead lines have; values in another unit are further off.
    constexpr double largest_stagger = 2., least_system_height = .1, largest_system_height = 10.;
    std::vector<std::string> result;
    const std::vector<LineLayout> parts = layouts();
    const std::vector<LineItems> of_parts = items_of_parts();
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      const bool is_rail = of_parts[i].is_rail;
      std::set<std::string> said;
      const auto say = [&](const std::string &what, const double value, const double x,
                           const std::string &reason)
      {
        if (said.insert(what).second)
          result.push_back(to_text(section_of(i), ": ", what, " of ", value, " m at x = ",
                                   parts[i].begin + x, " m ", reason, ". Lengths are read in m"));
      };
      const std::vector<LineMast> &masts = parts[i].masts;
      for (const LineMast &mast : masts)
      {
        for (const double z : {mast.contact_z, mast.messenger_z})
          if (std::fabs(z) > largest_stagger)
            say("a stagger", z, mast.x, to_text("is above ", largest_stagger, " m"));
        if (!is_rail &&
            !(mast.encumbrance >= least_system_height && mast.encumbrance <= largest_system_height))
          say("a system height (encumbrance)", mast.encumbrance, mast.x,
              to_text("is not between ", least_system_height, " and ", largest_system_height,
                      " m"));
      }
      for (std::size_t k = 0; k < parts[i].spans.size(); ++k)
        for (const LineDropper &dropper : parts[i].spans[k])
          if (const double height = std::max(masts[k].encumbrance, masts[k + 1].encumbrance);
              !is_rail && dropper.length > height + dropper.pre_sag +
                                               std::fabs(masts[k + 1].height - masts[k].height))
            say("a dropper", dropper.length, dropper.x,
                to_text("is longer than the system height of ", height, " m"));
    }
    return result;
  }

  void Catenary::check_given(const LineItems &own, const LineLayout &part) const
  {
    const LineItems usual;
    const std::string reference = "the reference line of EN 50318:2002";
    own.contact.check_given("Contact wire", usual.contact, reference);
    if (own.is_rail)
      return;
    own.messenger.check_given("Messenger wire", usual.messenger, reference);
    if (std::any_of(part.masts.begin(), part.masts.end(),
                    [](const LineMast &mast) { return mast.stitch_length > 0.; }))
      own.stitch.check_given("Stitch wires", usual.stitch, "a usual stitch wire");
  }

  void Catenary::check_wires(const std::vector<LineItems> &of_parts) const
  {
    const std::vector<LineLayout> parts = layouts();
    for (std::size_t i = 0; i < of_parts.size(); ++i)
    {
      const LineItems &own = of_parts[i];
      check_given(own, parts[i]);
      if (own.is_rail && own.contact.model != "beam")
        throw EntryError("Catenary/Contact wire/Model",
                         "a conductor rail bends: it is a 'beam', with a Bending stiffness");
      for (const auto &[wire, section] :
           {std::pair(&own.contact, "Contact wire"), std::pair(&own.messenger, "Messenger wire")})
        if (!own.is_rail && !(wire->tension > 0.))
          throw EntryError(
              std::string("Catenary/") + section + "/Tension",
              "it must be positive: the wire of an overhead line hangs by its tension");
    }
    for (std::size_t i = 0; i < items.masses.items.size(); ++i)
    {
      std::vector<std::string> known = {"contact", "messenger"};
      for (const std::string &name : tension_lengths.names)
        for (const char *const wire : {"contact ", "messenger "})
          known.push_back(wire + name);
      const std::string &wire = items.masses.items[i].wire;
      if (std::find(known.begin(), known.end(), wire) == known.end())
        throw EntryError(items.masses.title(i) + "/Wire",
                         "'" + wire + "' is not a wire" + suggestion(wire, known));
    }
  }

  void Catenary::check_uplift_positions(const std::vector<double> &positions,
                                        const Line &line) const
  {
    for (const double x : positions)
    {
      const bool is_on_wire = std::any_of(line.begin(), line.end(),
                                          [&](const TensionLength &part)
                                          { return x >= part.begin() && x <= part.end(); });
      if (is_on_wire)
        continue;
      const auto [first, last] = reach(line);
      throw EntryError("Catenary/Uplift positions",
                       to_text(x, " m is outside wire 'contact', ", first, " to ", last, " m"));
    }
  }

  /// Each is on a wire of some tension length, or it would be left out.
  void Catenary::check_point_masses(const Line &line) const
  {
    for (std::size_t i = 0; i < items.masses.items.size(); ++i)
    {
      const LineMassItem &item = items.masses.items[i];
      const std::string entry = items.masses.title(i) + "/Positions";
      for (const double x : parse_positions(item.positions, entry))
        if (std::none_of(line.begin(), line.end(),
                         [&](const TensionLength &part) {
                           return x >= part.begin() && x <= part.end() &&
                                  !part.wires_of(item).empty();
                         }))
        {
          const auto [first, last] = reach(line);
          throw EntryError(entry, to_text("no wire '", item.wire, "' is at ", x,
                                          " m; the line is from ", first, " to ", last, " m"));
        }
    }
  }

  void Catenary::check_lists(const PantographItem &item, const std::string &section) const
  {
    for (const auto &[entry, usual] : {std::pair("Masses", "7.2, 15 kg"),
                                       {"Stiffnesses", "4200, 50 N/m"},
                                       {"Dampings", "10, 90 N s/m"},
                                       {"Static force", "120 N at 250 km/h, lift included"}})
      if (item.given.count(entry) == 0)
        throw EntryError(section + "/" + entry,
                         to_text("it is not given, and decides the contact force; the pantograph "
                                 "of EN 50318:2002 has ",
                                 usual));
    const std::size_t n = item.masses.size();
    if (item.stiffnesses.size() != n || item.dampings.size() != n)
      throw EntryError(section, "Masses, Stiffnesses and Dampings are lists of one length; got " +
                                    std::to_string(n) + ", " +
                                    std::to_string(item.stiffnesses.size()) + ", " +
                                    std::to_string(item.dampings.size()));
    for (const auto &[list, entry] : {std::pair(&item.lift, "/Lift"),
                                      {&item.stop_gaps, "/Bump stop gaps"},
                                      {&item.stop_stiffnesses, "/Bump stop stiffnesses"}})
      if (!list->empty() && list->size() != n)
        throw EntryError(section + entry, std::to_string(list->size()) + " values for " +
                                              std::to_string(n) +
                                              " Masses; give one for each, or none");
    check_bump_stops(item, section);
  }

  std::vector<std::shared_ptr<const ForceLaw>> Catenary::stop_laws(const PantographItem &item,
                                                                   const std::string &section)
  {
    const std::string entry = section + "/Bump stop laws";
    const std::vector<std::string> tables = split(item.stop_laws, ';');
    if (tables.size() > item.masses.size())
      throw EntryError(entry, to_text(tables.size(), " laws for ", item.masses.size(),
                                      " Masses; give one for each, with ';' between them"));
    std::vector<std::shared_ptr<const ForceLaw>> laws(item.masses.size());
    for (std::size_t i = 0; i < tables.size(); ++i)
      if (!tables[i].empty())
        laws[i] = parse_table_law(tables[i], entry);
    return laws;
  }

  void Catenary::check_bump_stops(const PantographItem &item, const std::string &section) const
  {
    const auto laws = stop_laws(item, section);
    for (std::size_t i = 0; i < item.masses.size(); ++i)
    {
      const std::string mass = "mass " + std::to_string(i + 1);
      const bool is_stopped = i < item.stop_gaps.size() && item.stop_gaps[i] > 0.,
                 has_stiffness = i < item.stop_stiffnesses.size() && item.stop_stiffnesses[i] > 0.;
      if (laws[i] && !is_stopped)
        throw EntryError(section + "/Bump stop laws",
                         mass + " has a law, but no stop; give it one of the Bump stop gaps");
      if (laws[i] && has_stiffness)
        throw EntryError(section + "/Bump stop laws",
                         mass +
                             " has a law and one of the Bump stop stiffnesses; give one of both");
      if (is_stopped && !laws[i] && !has_stiffness)
        throw EntryError(section + "/Bump stop stiffnesses",
                         "give a positive one for each bump stop, of " + mass +
                             " too, or one of the Bump stop laws");
    }
  }

  Speed Catenary::speed_of(const PantographItem &item, const std::string &section)
  {
    constexpr double kilometres_per_hour = 3.6;
    return parse_speed(item.speed, section + "/Speed", kilometres_per_hour);
  }

  bool Catenary::is_as_fast(const PantographItem &a, const PantographItem &b,
                            const std::string &section)
  {
    if (a.speed == b.speed)
      return true;
    const Speed first = speed_of(a, section), second = speed_of(b, section);
    return !first.travel && !second.travel && first.constant == second.constant;
  }

  void Catenary::check_pantographs(const Line &line) const
  {
    const auto [first, last] = reach(line);
    for (std::size_t i = 0; i < pantographs.size(); ++i)
    {
      const PantographItem &item = pantograph_items[i];
      const std::string section = "Catenary/Pantograph " + pantographs[i];
      if (!(item.start >= first && item.start <= last))
        throw EntryError(section + "/Start", "the pantograph would stand outside the line, which "
                                             "reaches from " +
                                                 to_text(first, " to ", last) + " m");
      if (item.static_force < 0.)
        throw EntryError(section + "/Static force",
                         "it pushes the pantograph up, against the contact wire; a negative one "
                         "would keep it away from the wire. Give a force of at least 0");
      if (item.contact_damping > 0. &&
          std::isinf(parse_stiffness(item.contact_stiffness, section + "/Contact stiffness")))
        throw EntryError(section + "/Contact damping",
                         "a rigid contact has none; give it a finite Contact stiffness");
      for (std::size_t k = 0; k < i; ++k)
        if (item.start == pantograph_items[k].start &&
            is_as_fast(item, pantograph_items[k], section))
          throw EntryError(section + "/Start", "pantograph '" + pantographs[k] +
                                                   "' stands at the same place; give them "
                                                   "different ones");
    }
  }

  void Catenary::check_cant(const Line &line) const
  {
    const Expression cant = items.track_cant();
    if (cant.depends_on_time())
      throw EntryError("Catenary/Cant",
                       "'" + items.cant + "': a track does not move; write a formula in s");
    // Twice the cant that tracks have.
    constexpr double largest_cant = .25;
    constexpr unsigned int n_places = 1000;
    const auto [first, last] = reach(line);
    for (unsigned int i = 0; i <= n_places && !cant.is_zero(); ++i)
      if (const double x = first + (last - first) * i / n_places;
          !(std::fabs(cant(x, 0.)) < largest_cant))
        throw EntryError("Catenary/Cant",
                         to_text("it is ", cant(x, 0.), " at x = ", x, " m, and may be ",
                                 largest_cant,
                                 " at most: write the angle in rad, the cant over the gauge"));
  }
} // namespace taut
