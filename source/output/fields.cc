// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/gather_on_root.h"
#include "output/numbered_file.h"
#include "scene/entries.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/output/fields.h>
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <numeric>
#include <utility>

namespace taut
{
  namespace
  {
    void append(const Coordinates &p, std::vector<float> &values)
    {
      for (const double value : {p.x, p.y, p.z})
        values.push_back(static_cast<float>(value));
    }

    std::vector<float> values_of(const std::vector<Coordinates> &places)
    {
      std::vector<float> values;
      values.reserve(3 * places.size());
      for (const Coordinates &place : places)
        append(place, values);
      return values;
    }
  } // namespace

  Fields::Fields(const std::string &results, const Scene &scene, const SceneBodies &structure,
                 const double interval, const unsigned int subdivisions)
      : folder(results + "/fields/"), interval(interval),
        is_root(structure.communicator().is_root()), wire_collection(folder + "wires.pvd"),
        link_collection(folder + "links.pvd")
  {
    if (interval == 0.)
      return;
    structure.communicator().agree(
        [&]
        {
          if (is_root)
            make_fields_folder(results);
        });
    if (!scene.wires.empty())
      add_wires(scene, structure, subdivisions);
    if (!scene.links.empty())
      add_links(scene, structure);
    add_bodies(scene, structure);
  }

  void Fields::add_wires(const Scene &scene, const SceneBodies &structure,
                         const unsigned int subdivisions)
  {
    std::vector<std::vector<std::int32_t>> lines;
    std::vector<std::int32_t> numbers, parts;
    std::vector<std::string> names;
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      const std::vector<double> nodes = grid(scene, w);
      for (std::size_t e = 0; e + 1 < nodes.size(); ++e)
      {
        const std::int32_t part = structure.part(w, .5 * (nodes[e] + nodes[e + 1]));
        if (is_root && (e == 0 || part != parts.back()))
        {
          lines.emplace_back();
          if (e > 0)
            lines.back().push_back(wires.size - 1);
          numbers.push_back(w);
          parts.push_back(part);
          names.push_back(scene.wires[w].name);
        }
        for (unsigned int k = e == 0 ? 0 : 1; k <= subdivisions; ++k)
        {
          const double s = nodes[e] + (nodes[e + 1] - nodes[e]) * k / subdivisions;
          if (is_root)
            lines.back().push_back(wires.size);
          wires.add(scene, structure, {Attachment::Kind::wire, w, s});
        }
      }
    }
    if (!is_root)
      return;
    wire_file = std::make_unique<VtuFile>(wires.size, lines);
    wire_file->set(VtuFile::positions, values_of(wires.places));
    wires.places = std::vector<Coordinates>(); // without its memory
    wire_displacement = wire_file->add(VtuFile::Location::points, "displacement", 3, "m");
    wire_file->add(VtuFile::Location::cells, "wire", numbers);
    wire_file->add(VtuFile::Location::cells, "part", parts);
    wire_file->add(VtuFile::Location::cells, "name", names);
  }

  void Fields::add_links(const Scene &scene, const SceneBodies &structure)
  {
    std::vector<std::vector<std::int32_t>> lines;
    std::vector<std::string> names;
    for (const bool moving : {false, true})
    {
      for (std::size_t i = 0; i < scene.links.size(); ++i)
      {
        const Link &link = scene.links[i];
        if (link.moving() != moving)
          continue;
        lines.emplace_back();
        names.push_back(link.name);
        Link::visit_places(link,
                           [&](const Attachment &end)
                           {
                             if (end.kind == Attachment::Kind::ground && !end.has_place)
                               return;
                             lines.back().push_back(ends.size);
                             ends.add(scene, structure, end);
                             link_of_end.push_back(i);
                           });
      }
      if (!moving)
        n_fixed_ends = ends.size;
    }
    if (!is_root)
      return;
    link_file = std::make_unique<VtuFile>(ends.size, lines);
    link_displacement = link_file->add(VtuFile::Location::points, "displacement", 3, "m");
    force = link_file->add(VtuFile::Location::points, "force", 1, "N, N m");
    gap = link_file->add(VtuFile::Location::points, "gap", 1, "m, rad");
    open = link_file->add(VtuFile::Location::points, "open", 1, "1");
    link_file->add(VtuFile::Location::cells, "name", names);
  }

  void Fields::Points::set_motion(const SceneBodies &structure, const std::size_t number,
                                  const Attachment &at)
  {
    Moved point{number, {}};
    bool is_here = false;
    for (unsigned int i = 0; i < 3; ++i)
    {
      structure.motion(at, false, {i == 0 ? 1. : 0., i == 1 ? 1. : 0., i == 2 ? 1. : 0.}, 1.,
                       point.motion[i]);
      is_here = is_here || !point.motion[i].empty();
    }
    if (is_here)
      moved.push_back(std::move(point));
  }

  void Fields::Points::add(const Scene &scene, const SceneBodies &structure, const Attachment &at)
  {
    const Coordinates place = structure.position(scene, at);
    if (structure.communicator().is_root())
      places.push_back(place);
    set_motion(structure, size, at);
    ++size;
  }

  std::vector<float> Fields::displacements(const Points &points, const StepView &step) const
  {
    const BodyVectors &reference = step.reference.displacement, &U = step.state.U;
    std::vector<double> own, all;
    own.reserve(4 * points.moved.size());
    for (const Points::Moved &point : points.moved)
    {
      own.push_back(static_cast<double>(point.number));
      for (const std::vector<Term> &terms : point.motion)
        own.push_back(evaluate(terms, reference) + evaluate(terms, U));
    }
    gather_on_root(step.structure.communicator(), own, all);
    std::vector<double> sums(is_root ? 3 * points.size : 0, 0.);
    for (std::size_t i = 0; i < all.size(); i += 4)
      for (unsigned int c = 0; c < 3; ++c)
        sums[3 * static_cast<std::size_t>(all[i]) + c] += all[i + 1 + c];
    return std::vector<float>(sums.begin(), sums.end());
  }

  void Fields::record(const StepView &step)
  {
    // A step within rounding of its time is due.
    if (interval == 0. || step.state.time < next - 1e-9 * interval)
      return;
    next = step.state.time + interval;
    move_ends(step);
    const std::vector<float> of_wires = displacements(wires, step),
                             of_ends = displacements(ends, step);
    if (wire_file)
      wire_file->set(wire_displacement, of_wires);
    if (link_file)
    {
      link_file->set(link_displacement, of_ends);
      set_links(step.links);
    }
    const auto write_files = [&]
    {
      write_bodies(step);
      if (wire_file)
        write(step, "wires", *wire_file, wire_collection);
      if (link_file)
        write(step, "links", *link_file, link_collection);
    };
    step.structure.communicator().agree(write_files);
  }

  void Fields::save(OutputArchive &archive)
  {
    archive << next;
    const auto save_collection = [&](PvdFile &collection)
    {
      const std::size_t n = collection.size(), length = collection.length();
      archive << n << length;
    };
    save_collection(wire_collection);
    save_collection(link_collection);
    for (BodyFiles &body : bodies)
    {
      archive << body.n_frames;
      save_collection(body.collection);
    }
  }

  void Fields::resume(InputArchive &archive, const StepView &)
  {
    archive >> next;
    const auto load_collection = [&](PvdFile &collection)
    {
      std::size_t n = 0, length = 0;
      archive >> n >> length;
      if (is_root)
        collection.resume(n, length);
    };
    load_collection(wire_collection);
    load_collection(link_collection);
    for (BodyFiles &body : bodies)
    {
      archive >> body.n_frames;
      load_collection(body.collection);
    }
  }

  void Fields::finish()
  {
    wire_collection.close();
    link_collection.close();
    for (BodyFiles &body : bodies)
      body.collection.close();
  }

  void Fields::move_ends(const StepView &step)
  {
    while (!ends.moved.empty() && ends.moved.back().number >= n_fixed_ends)
      ends.moved.pop_back();
    for (std::size_t e = n_fixed_ends; e < ends.size; ++e)
    {
      const Link &link = step.scene.links[link_of_end[e]];
      const double s = step.constraints.position(step.constraints.index_of_link(link_of_end[e]),
                                                 step.state.time);
      const Attachment contact = SceneBodies::moved(link.to, s);
      // The `to` end is the last of its link. Both are drawn at the contact.
      const bool is_last = e + 1 == ends.size || link_of_end[e + 1] != link_of_end[e];
      ends.set_motion(step.structure, e, is_last ? contact : link.from);
      const Coordinates place = step.structure.position(step.scene, contact);
      if (is_root)
        ends.places[e] = place;
    }
  }

  void Fields::set_links(const LinkValues &links)
  {
    std::vector<float> forces, gaps, opened;
    for (const std::size_t link : link_of_end)
    {
      forces.push_back(static_cast<float>(links.force[link]));
      gaps.push_back(static_cast<float>(links.gap[link]));
      opened.push_back(links.force[link] == 0. ? 1.f : 0.f);
    }
    link_file->set(VtuFile::positions, values_of(ends.places));
    link_file->set(force, forces);
    link_file->set(gap, gaps);
    link_file->set(open, opened);
  }

  void Fields::write(const StepView &step, const std::string &name, const VtuFile &file,
                     PvdFile &collection) const
  {
    const std::string frame = numbered(name, collection.size());
    file.write(folder + frame);
    collection.add(step.state.time, frame);
  }
} // namespace taut
