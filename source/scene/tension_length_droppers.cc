// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/csv_table.h"
#include "base/text.h"
#include "scene/entries.h"
#include "scene/line_geometry.h"
#include "scene/shared_places.h"
#include "scene/tension_length.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  /**
   * Gives the droppers of one span of a wire, from x = @p begin to @p end [m] in the scene, their
   * lengths in the table of droppers of an earlier run, @p built. As many as there were take them
   * from the first to the last, so that some may hang elsewhere than before. Of more or fewer each
   * takes that of the one at its place. @p name begins the names of the droppers, and @p origin is
   * x of the begin of the line [m]. Throws EntryError on @p entry.
   */
  void take_lengths(const CsvTable &built, const std::string &entry, const std::string &name,
                    const std::string &wire, double begin, double end, double origin,
                    std::vector<LineDropper *> droppers);

  void take_lengths(const CsvTable &built, const std::string &entry, const std::string &name,
                    const std::string &wire, const double begin, const double end,
                    const double origin, std::vector<LineDropper *> droppers)
  {
    constexpr double same_place = 1e-3;                // of a clamp [m]
    std::vector<std::pair<double, std::size_t>> known; ///< x and row
    for (std::size_t row = 0; row < built.n_rows(); ++row)
      if (built.text(row, "lower wire") == wire && built.text(row, "dropper").find(name) == 0)
        if (const double x = built.number(row, "x [m]"); x > begin && x < end)
          known.emplace_back(x, row);
    std::sort(known.begin(), known.end());
    std::sort(droppers.begin(), droppers.end(),
              [](const LineDropper *a, const LineDropper *b) { return a->x < b->x; });
    for (std::size_t i = 0; i < droppers.size(); ++i)
    {
      const double x = origin + droppers[i]->x;
      const auto found = known.size() == droppers.size()
                             ? known.begin() + i
                             : std::find_if(known.begin(), known.end(),
                                            [x](const std::pair<double, std::size_t> &at)
                                            { return std::fabs(at.first - x) < same_place; });
      if (found == known.end())
        throw EntryError(entry,
                         to_text("droppers.csv there has ", known.size(), " droppers on wire '",
                                 wire, "' from ", begin, " to ", end, " m, none of them at ", x,
                                 " m, where one of ", droppers.size(),
                                 " hangs. Give as many, or those at places of the file"));
      droppers[i]->length = built.number(found->second, "cut length [m]");
      droppers[i]->built = built.number(found->second, "length as built [m]");
      if (!(droppers[i]->length > 0. && droppers[i]->built > 0.))
        built.fail(found->second, "a dropper has a positive length");
    }
  }

  void TensionLength::add_stitch_wires()
  {
    for (std::size_t i = 0; i < line.masts.size(); ++i)
    {
      const LineMast &mast = line.masts[i];
      if (mast.stitch_length == 0.)
        continue;
      const double first = mast.x - .5 * mast.stitch_length,
                   last = mast.x + .5 * mast.stitch_length, y = scene.wires[messenger].a.y;
      const std::string number = std::to_string(i);
      Wire wire =
          items.stitch.wire(named("stitch") + " " + number, "Stitch wires",
                            {begin() + first, y, line.offset}, {begin() + last, y, line.offset});
      wire.has_lateral = items.is_in_space;
      stitches[i] = scene.wires.size();
      scene.wires.push_back(wire);
      scene.wires[messenger].tension_changes.push_back({first, last, -items.stitch.tension});
      for (const bool is_last : {false, true})
        for (const Coordinates &axis : {Coordinates{0., 1.}, Coordinates{0., 0., 1.}})
        {
          if (axis.z != 0. && !items.is_in_space)
            continue;
          Link clamp;
          clamp.name = named("stitch clamp") + " " + number + (is_last ? " right" : " left") +
                       (axis.z != 0. ? " z" : "");
          clamp.origin = "Catenary/Stitch wires";
          clamp.from = {Attachment::Kind::wire, messenger, is_last ? last : first};
          clamp.to = {Attachment::Kind::wire, stitches[i], is_last ? wire.length() : 0.};
          clamp.direction = axis;
          scene.links.push_back(clamp);
        }
    }
  }

  Attachment TensionLength::carrier(const double x) const
  {
    for (std::size_t i = 0; i < line.masts.size(); ++i)
    {
      const double s = x - (line.masts[i].x - .5 * line.masts[i].stitch_length);
      if (stitches[i] != ground && s > 0. && s < line.masts[i].stitch_length)
        return {Attachment::Kind::wire, stitches[i], s};
    }
    return {Attachment::Kind::wire, messenger, x};
  }

  void TensionLength::add_dropper(const LineDropper &dropper, const double height,
                                  const std::string &dropper_name, const std::size_t contact)
  {
    Link link;
    link.kind = LinkKind::dropper;
    link.origin = "Catenary/Droppers";
    link.name = dropper_name;
    link.from = carrier(dropper.x);
    link.to = {Attachment::Kind::wire, contact, dropper.x};
    link.direction = {0., -1.};
    link.stiffness = parse_stiffness(items.droppers.stiffness, "Catenary/Droppers/Stiffness");
    link.damping = items.droppers.damping;
    if (dropper.length == 0.)
    {
      link.form.find_length = true;
      link.form.prescribed_displacement = height - dropper.pre_sag;
      link.form.axial_stiffness = items.droppers.axial_stiffness;
      link.form.mass_per_length = items.droppers.mass_per_length;
      link.form.find_direction = items.is_in_space;
    }
    else
    {
      link.unstressed_length = dropper.length;
      link.length = dropper.built > 0. ? dropper.built : dropper.length;
      link.gap = dropper.length - (scene.wires[messenger].a.y - scene.wires[contact].a.y);
      if (items.droppers.axial_stiffness > 0.)
        link.stiffness = items.droppers.axial_stiffness / link.length;
      link.form.find_direction = items.is_in_space;
      const double half = .5 * items.droppers.mass_per_length * link.length;
      for (const Attachment *const end : {&link.from, &link.to})
        if (half > 0.)
          scene.point_masses.push_back(
              {link.name, link.origin, end->index, {end->position}, half, true});
    }
    if (link.from.index != messenger && items.droppers.messenger_clamp_mass > 0.)
      scene.point_masses.push_back({link.name + " clamp",
                                    link.origin,
                                    link.from.index,
                                    {link.from.position},
                                    items.droppers.messenger_clamp_mass,
                                    true});
    scene.links.push_back(link);
  }

  void TensionLength::add_droppers()
  {
    std::vector<double> places;
    for (const std::vector<LineDropper> &span : line.spans)
      for (const LineDropper &dropper : span)
        places.push_back(dropper.x);
    const std::vector<double> heights = line.heights(places);
    std::vector<double> on_messenger;
    std::vector<std::vector<double>> held(contacts.size());
    const auto hangs = [&](const std::size_t i, const std::size_t k)
    { return !items.hangs_in_turn || i % contacts.size() == k; };
    const auto name_of = [&](const std::size_t k)
    { return (k == 0 ? "" : "twin ") + named("dropper") + " "; };
    std::vector<std::vector<std::vector<LineDropper>>> spans(contacts.size(), line.spans);
    if (!line.built_in.empty())
    {
      const std::string entry = section + "/Droppers/Lengths";
      const CsvTable built(line.built_in + "/droppers.csv", entry);
      for (std::size_t k = 0; k < contacts.size(); ++k)
        for (std::size_t span = 0; span < line.spans.size(); ++span)
        {
          std::vector<LineDropper *> own;
          for (std::size_t i = 0; i < spans[k][span].size(); ++i)
            if (hangs(i, k))
              own.push_back(&spans[k][span][i]);
          take_lengths(built, entry, name_of(k), scene.wires[contacts[k]].name,
                       begin() + line.masts[span].x, begin() + line.masts[span + 1].x, begin(),
                       own);
        }
    }
    std::size_t next = 0;
    for (std::size_t span = 0; span < line.spans.size(); ++span)
      for (std::size_t i = 0; i < line.spans[span].size(); ++i, ++next)
      {
        const LineDropper &dropper = line.spans[span][i];
        // All names have the same number of digits: 1.11 and 11.1 are one name to programs that
        // drop the point.
        std::string index = std::to_string(i + 1);
        index.insert(0, std::to_string(line.spans[span].size()).size() - index.size(), '0');
        for (std::size_t k = 0; k < contacts.size(); ++k)
        {
          if (!hangs(i, k))
            continue;
          add_dropper(spans[k][span][i], heights[next],
                      name_of(k) + std::to_string(span + 1) + "." + index, contacts[k]);
          held[k].push_back(dropper.x);
          if (scene.links.back().from.index == messenger)
            on_messenger.push_back(dropper.x);
        }
      }
    const auto add_clamps = [&](const std::string &what, const std::size_t wire,
                                const std::vector<double> &at, const double mass)
    {
      if (mass > 0. && !at.empty())
        scene.point_masses.push_back({what, "Catenary/Droppers", wire, at, mass, true});
    };
    add_clamps(named("messenger clamp"), messenger, on_messenger,
               items.droppers.messenger_clamp_mass);
    for (std::size_t k = 0; k < contacts.size(); ++k)
      add_clamps((k == 0 ? "" : "twin ") + named("contact clamp"), contacts[k], held[k],
                 items.droppers.contact_clamp_mass);
  }

  void TensionLength::add_mid_points()
  {
    const LineMidPointItem &own = items.mid_point;
    for (std::size_t i = 0; i < line.masts.size(); ++i)
    {
      const LineMast &mast = line.masts[i];
      if (mast.mid_point == 0.)
        continue;
      for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        const auto change = [&](const std::size_t wire, const double between, const double tension)
        {
          scene.wires[wire].tension_changes.push_back(
              {mast.x - .5 * between, mast.x + .5 * between, tension});
        };
        change(contacts[k], mast.mid_point, -own.pull);
        if (own.messenger_distance > 0.)
          change(messenger, own.messenger_distance, own.pull);
        for (const bool is_last : {false, true})
        {
          const double side = is_last ? .5 : -.5;
          Link rope;
          rope.kind = LinkKind::dropper;
          rope.origin = "Catenary/Mid-point ropes";
          rope.name = (k == 0 ? "" : "twin ") + named("mid-point rope") + " " + std::to_string(i) +
                      (is_last ? " right" : " left");
          rope.from = {Attachment::Kind::wire, messenger, mast.x + side * own.messenger_distance};
          rope.to = {Attachment::Kind::wire, contacts[k], mast.x + side * mast.mid_point};
          rope.direction = {0., -1.};
          rope.form.find_length = true;
          rope.form.pull = own.pull;
          rope.form.axial_stiffness = own.axial_stiffness;
          rope.form.mass_per_length = own.mass_per_length;
          rope.form.find_direction = items.is_in_space;
          scene.links.push_back(rope);
        }
      }
    }
  }

  void TensionLength::check_mid_points() const
  {
    const std::string ropes = "Catenary/Mid-point ropes/";
    for (std::size_t i = 0; i < line.masts.size(); ++i)
    {
      const LineMast &mast = line.masts[i];
      if (mast.mid_point == 0.)
        continue;
      const double half = .5 * mast.mid_point;
      if (!(half < mast.x - line.masts[i - 1].x) || !(half < line.masts[i + 1].x - mast.x))
        throw EntryError(section + "/Mid-points",
                         to_text("the ropes of the mid-point at x = ", begin() + mast.x,
                                 " m, with ", mast.mid_point,
                                 " m between them, reach beyond a neighbouring mast"));
      if (!(items.mid_point.messenger_distance < mast.mid_point))
        throw EntryError(ropes + "Messenger distance",
                         to_text("the ropes run outwards from the messenger wire; give it less "
                                 "than the ",
                                 mast.mid_point, " m on the contact wire"));
      if (!(items.mid_point.pull > 0. && items.mid_point.pull < items.contact.tension))
        throw EntryError(ropes + "Pull", to_text(items.mid_point.pull,
                                                 " N; a rope needs a pull above 0, and the "
                                                 "contact wire loses it between the ropes, "
                                                 "so that it has to be less than its tension"));
      if (!(items.mid_point.axial_stiffness > 0.))
        throw EntryError(ropes + "Axial stiffness", "give that of the ropes, in N");
    }
  }

  void TensionLength::check_droppers() const
  {
    const std::string entry = section + "/Droppers/Positions";
    const double same =
        std::min(same_place(scene.wires[contacts.front()]), same_place(scene.wires[messenger]));
    for (std::size_t span = 0; span < line.spans.size(); ++span)
    {
      const double begin = line.masts[span].x, length = line.masts[span + 1].x - begin;
      std::vector<double> sorted;
      for (const LineDropper &dropper : line.spans[span])
        sorted.push_back(dropper.x - begin);
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t i = 0; i < sorted.size(); ++i)
      {
        if (!(sorted[i] > 0. && sorted[i] < length))
          throw EntryError(entry,
                           to_text(sorted[i], " m is not inside its span of ", length, " m"));
        if (i > 0 && sorted[i] - sorted[i - 1] <= same)
          throw EntryError(entry, to_text("two droppers hang at ", sorted[i],
                                          " m; remove one, or give one the stiffness of both"));
      }
    }
  }

  /// A rail has no messenger wire, and moves in the plane.
  void TensionLength::check_rail() const
  {
    if (!(items.supports.arm_stiffness > 0.))
      throw EntryError("Catenary/Supports/Arm stiffness",
                       "a conductor rail rests on the springs of its arms; give it one in N/m");
    if (items.supports.has_rigid_arms())
      throw EntryError("Catenary/Supports/Arm kind",
                       "a conductor rail moves in the plane; take 'hinged' or 'point mass'");
    for (const LineMast &mast : line.masts)
      for (const auto &[value, entry] : {std::pair(mast.stitch_length, "/Stitch lengths"),
                                         {mast.mid_point, "/Mid-points"},
                                         {mast.contact_z, "/Contact wire/Stagger"},
                                         {mast.messenger_z, "/Messenger wire/Stagger"}})
        if (value != 0.)
          throw EntryError(section + entry,
                           "a conductor rail has no messenger wire, and moves in the plane; leave "
                           "it out");
  }

  void TensionLength::check() const
  {
    if (items.is_rail)
    {
      check_rail();
      return;
    }
    for (std::size_t i = 0; i < line.masts.size(); ++i)
    {
      const LineMast &mast = line.masts[i];
      if (mast.stitch_length == 0.)
        continue;
      const double half = .5 * mast.stitch_length;
      if (i == 0 || i + 1 == line.masts.size() || !(half < mast.x - line.masts[i - 1].x) ||
          !(half < line.masts[i + 1].x - mast.x))
        throw EntryError(section + "/Stitch lengths",
                         to_text("the stitch wire of ", mast.stitch_length, " m at x = ",
                                 begin() + mast.x, " m reaches beyond a neighbouring mast"));
      if (!(items.stitch.tension < items.messenger.tension))
        throw EntryError("Catenary/Stitch wires/Tension",
                         "the stitch wire takes it from the messenger wire between its clamps, and "
                         "none is left there; give it less than the messenger wire has");
    }
    check_mid_points();
    check_droppers();
  }
} // namespace taut
