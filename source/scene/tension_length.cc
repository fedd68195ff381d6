// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/tension_length.h"

#include "base/text.h"
#include "scene/entries.h"
#include "scene/written_items.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace taut
{
  TensionLength::TensionLength(const LineItems &items, const LineLayout &layout,
                               const std::string &name, const std::string &section, Scene &scene)
      : items(items), line(layout), name(name), section(section), scene(scene),
        stitches(layout.masts.size(), ground)
  {
    const double above = line.masts.front().height + line.masts.front().encumbrance;
    if (!items.is_rail)
    {
      messenger = scene.wires.size();
      scene.wires.push_back(items.messenger.wire(named("messenger"), "Messenger wire",
                                                 {begin(), above, line.offset},
                                                 {end(), above, line.offset}));
    }
    for (unsigned int i = 0; i < items.n_contact_wires; ++i)
    {
      contacts.push_back(scene.wires.size());
      scene.wires.push_back(items.contact.wire((i == 0 ? "" : "twin ") + named("contact"),
                                               "Contact wire", {begin(), 0., line.offset},
                                               {end(), 0., line.offset}));
    }
  }

  /// "contact", or "contact A" of a line with several tension lengths.
  std::string TensionLength::named(const std::string &what) const
  {
    return name.empty() ? what : what + " " + name;
  }

  void TensionLength::hold(Support support, const std::vector<double> &s,
                           const std::vector<double> &displacement)
  {
    const std::string first = support.name;
    if (std::all_of(displacement.begin(), displacement.end(),
                    [](const double d) { return d == 0.; }))
    {
      support.positions = s;
      scene.supports.push_back(support);
      return;
    }
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      support.name = first + " " + std::to_string(i + 1);
      support.positions = {s[i]};
      support.prescribed = Expression(displacement[i]);
      scene.supports.push_back(support);
    }
  }

  void TensionLength::add_supports()
  {
    const LineMast &first = line.masts.front(), &last = line.masts.back();
    const double above = first.height + first.encumbrance;
    Support ends;
    ends.origin = section;
    if (!items.is_rail)
    {
      ends.name = scene.wires[messenger].name + " ends";
      ends.wire = messenger;
      hold(ends, {0., line.length()}, {0., last.height + last.encumbrance - above});
    }
    for (const std::size_t contact : contacts)
    {
      ends.name = scene.wires[contact].name + " ends";
      ends.wire = contact;
      hold(ends, {0., line.length()}, {first.height, last.height});
    }

    std::vector<double> masts, heights;
    for (std::size_t i = 1; i + 1 < line.masts.size(); ++i)
    {
      masts.push_back(line.masts[i].x);
      heights.push_back(line.masts[i].height + line.masts[i].encumbrance - above);
    }
    if (masts.empty())
      return;
    if (!items.is_rail)
    {
      const std::string entry = "Catenary/Supports/Messenger ";
      Support mast;
      mast.name = named("messenger") + " at masts";
      mast.origin = "Catenary/Supports";
      mast.wire = messenger;
      const double stiffness =
          parse_stiffness(items.supports.messenger_stiffness, entry + "stiffness");
      mast.fixed = std::isinf(stiffness);
      mast.stiffness = mast.fixed ? 0. : stiffness;
      mast.damping = items.supports.messenger_damping;
      if (mast.fixed && mast.damping > 0.)
        throw EntryError(entry + "damping",
                         "a rigid support has none; give it a Messenger stiffness in N/m");
      hold(mast, masts, heights);
    }
    for (const std::size_t contact : contacts)
      add_arms(contact, masts);
  }

  std::vector<std::size_t> TensionLength::wires_of(const LineMassItem &item) const
  {
    std::vector<std::size_t> result;
    for (const std::size_t wire : contacts)
      if (item.wire == scene.wires[wire].name || item.wire == "contact")
        result.push_back(wire);
    if (!items.is_rail && (item.wire == scene.wires[messenger].name || item.wire == "messenger"))
      result.push_back(messenger);
    return result;
  }

  void TensionLength::add_point_masses()
  {
    for (std::size_t i = 0; i < items.masses.items.size(); ++i)
    {
      const LineMassItem &item = items.masses.items[i];
      const std::string title = items.masses.title(i);
      for (const std::size_t wire : wires_of(item))
      {
        PointMass mass{named(items.masses.names[i]), title, wire, {}, item.mass, true};
        for (const double x : parse_positions(item.positions, title + "/Positions"))
          if (x >= begin() && x <= end())
            mass.positions.push_back(x - begin());
        if (!mass.positions.empty())
          scene.point_masses.push_back(mass);
      }
    }
  }

  void TensionLength::add_probes(const std::vector<double> &x)
  {
    std::vector<double> places = x;
    if (x.empty())
      for (std::size_t i = 1; i + 1 < line.masts.size(); ++i)
        places.push_back(begin() + line.masts[i].x);
    const bool whole = std::all_of(places.begin(), places.end(),
                                   [](const double p) { return p == std::floor(p); });
    for (const double place : places)
    {
      if (place < begin() || place > end())
        continue;
      Probe probe;
      probe.origin = "Catenary/Uplift positions";
      // All names have the same number of decimals, so that no two names differ by the point alone.
      std::ostringstream text;
      text << std::fixed << std::setprecision(whole ? 0 : 3)
           << (name.empty() ? "contact wire" : named("contact")) << " at " << place << " m";
      probe.name = text.str();
      probe.point = {Attachment::Kind::wire, contacts.front(), place - begin()};
      scene.probes.push_back(probe);
    }
  }

  /// Supports along z, each with its own name and place.
  void TensionLength::hold_aside(const std::size_t wire, const std::string &what,
                                 double LineMast::*const stagger,
                                 const std::function<bool(std::size_t)> &is_held)
  {
    for (std::size_t mast = 0; mast < line.masts.size(); ++mast)
    {
      if (!is_held(mast))
        continue;
      Support support;
      support.name = named(what) + " " + std::to_string(mast);
      support.origin = section;
      support.wire = wire;
      support.positions = {line.masts[mast].x};
      support.motion = WireMotion::lateral;
      support.prescribed = Expression(line.masts[mast].*stagger);
      scene.supports.push_back(support);
    }
  }

  /// In coordinates along the track a straight wire has the curvature -k: its tension is balanced
  /// as by the load T k.
  void TensionLength::add_curvature(const std::size_t wire)
  {
    const Expression curvature = items.track_curvature(begin());
    if (curvature.is_zero())
      return;
    if (curvature.depends_on_time())
      throw EntryError("Catenary/Curvature", "'" + curvature.formula() +
                                                 "': a track does not move; write a formula in s");
    add_load(
        wire, "curve of ",
        Expression(written_number(scene.wires[wire].tension) + "*(" + curvature.formula() + ")",
                   "Catenary/Curvature"),
        {0., 0., 1.});
    scene.loads.back().acts_while_built = true;
  }

  /// A force per length that comes once the line is built; nothing if it is zero.
  void TensionLength::add_load(const std::size_t wire, const std::string &what,
                               const Expression &magnitude, const Coordinates &direction)
  {
    if (magnitude.is_zero())
      return;
    Load load;
    load.name = what + scene.wires[wire].name;
    load.origin = scene.wires[wire].origin;
    load.kind = Load::Kind::distributed;
    load.target = {Attachment::Kind::wire, wire, 0.};
    load.direction = direction;
    load.magnitude = magnitude;
    load.acts_while_built = false;
    scene.loads.push_back(load);
  }

  void TensionLength::add_vertical_loads()
  {
    const auto add = [this](const std::size_t wire, const LineWireItem &item,
                            const std::string &section) {
      add_load(wire, "vertical load on ", item.load_along_y(section, begin()), {0., 1., 0.});
    };
    for (const std::size_t contact : contacts)
      add(contact, items.contact, "Contact wire");
    if (!items.is_rail)
      add(messenger, items.messenger, "Messenger wire");
  }

  void TensionLength::add_lateral()
  {
    const auto all = [](std::size_t) { return true; };
    const auto without_arm = [this](const std::size_t mast)
    { return !items.supports.has_rigid_arms() || mast == 0 || mast + 1 == line.masts.size(); };
    hold_aside(messenger, "messenger aside at mast", &LineMast::messenger_z, all);
    std::vector<std::pair<std::size_t, Expression>> loads = {
        {messenger, items.messenger.wind_load("Messenger wire", begin())}};
    for (const std::size_t contact : contacts)
    {
      hold_aside(contact,
                 contact == contacts.front() ? "steady arm at mast" : "twin steady arm at mast",
                 &LineMast::contact_z, without_arm);
      loads.emplace_back(contact, items.contact.wind_load("Contact wire", begin()));
    }
    for (const auto &[wire, load] : loads)
    {
      scene.wires[wire].has_lateral = true;
      add_curvature(wire);
      add_load(wire, "wind on ", load, {0., 0., 1.});
    }
  }
} // namespace taut
