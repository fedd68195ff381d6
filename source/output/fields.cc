// SPDX-License-Identifier: LGPL-2.1-or-later
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
    std::string numbered(const std::string &name, const std::size_t number,
                         const char *const ending = ".vtu")
    {
      char text[32];
      std::snprintf(text, sizeof text, "_%05zu", number);
      return name + text + ending;
    }

    /// nullptr: the body is drawn by itself.
    const PartOfBody *part(const Structure &structure, const std::size_t k)
    {
      return dynamic_cast<const PartOfBody *>(&structure[k]);
    }

    /// Keeps letters, digits, '-' and non-ASCII characters; '_' replaces others.
    std::string name_in_files(std::string name)
    {
      for (char &c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' &&
            !(static_cast<unsigned char>(c) & 0x80))
          c = '_';
      return name;
    }

    void append(const Coordinates &p, std::vector<float> &values)
    {
      for (const double value : {p.x, p.y, p.z})
        values.push_back(static_cast<float>(value));
    }

    template <typename Samples>
    std::vector<float> places(const Samples &samples)
    {
      std::vector<float> values;
      values.reserve(3 * samples.size());
      for (const auto &sample : samples)
        append(sample.place, values);
      return values;
    }
  } // namespace

  Fields::Fields(const std::string &results, const Scene &scene, const SceneBodies &structure,
                 const double interval, const unsigned int subdivisions)
      : folder(results + "/fields/"), interval(interval), wire_collection(folder + "wires.pvd"),
        link_collection(folder + "links.pvd")
  {
    if (interval == 0.)
      return;
    structure.communicator().agree(
        [&]
        {
          if (structure.communicator().is_root())
            make_fields_folder(results);
        });
    if (!scene.wires.empty())
      add_wires(scene, structure, subdivisions);
    if (!scene.links.empty())
      add_links(scene, structure);
    add_bodies(scene, structure);
  }

  void Fields::add_bodies(const Scene &scene, const SceneBodies &structure)
  {
    std::vector<double> shown(scene.bodies.size(), 0.);
    for (std::size_t i = 0; i < shown.size(); ++i)
    {
      for (const std::size_t k : structure.indices_of_body(i))
        if (k != Structure::elsewhere && structure[k].has_fields())
          shown[i] = 1.;
    }
    structure.communicator().sum(shown);
    for (std::size_t i = 0; i < shown.size(); ++i)
      if (shown[i] > 0.)
      {
        const std::string stem = "body_" + name_in_files(scene.bodies[i].name);
        for (const BodyFiles &other : bodies)
          if (other.stem == stem)
            throw EntryError(scene.bodies[i].origin, "its files would be '" + stem +
                                                         "_*.vtu', which are those of another "
                                                         "body; rename one");
        const std::vector<std::size_t> &parts = structure.indices_of_body(i);
        BodyFiles files = {stem, PvdFile(folder + stem + ".pvd"), pieces_of(structure, parts)};
        if (parts.size() > 1)
        {
          const Communicator &processes = structure.communicator();
          std::vector<std::size_t> sizes;
          processes.gather(files.pieces.size(), sizes);
          const auto own = sizes.begin() + processes.rank();
          files.first_piece = std::accumulate(sizes.begin(), own, std::size_t(0));
          files.n_pieces = std::accumulate(own, sizes.end(), files.first_piece);
          files.is_joined = files.n_pieces > 1 &&
                            !processes.any(std::any_of(files.pieces.begin(), files.pieces.end(),
                                                       [&](const std::vector<std::size_t> &piece) {
                                                         return !part(structure, piece.front());
                                                       }));
        }
        bodies.push_back(std::move(files));
      }
  }

  std::vector<std::vector<std::size_t>> Fields::pieces_of(const SceneBodies &structure,
                                                          const std::vector<std::size_t> &parts)
  {
    std::vector<std::vector<std::size_t>> pieces;
    for (const std::size_t k : parts)
    {
      if (k == Structure::elsewhere)
        continue;
      const PartOfBody *const own = part(structure, k);
      const auto with = std::find_if(pieces.begin(), pieces.end(),
                                     [&](const std::vector<std::size_t> &piece)
                                     {
                                       const PartOfBody *const other =
                                           part(structure, piece.front());
                                       return own && other && own->is_drawn_with(*other);
                                     });
      if (with == pieces.end())
        pieces.push_back({k});
      else
        with->push_back(k);
    }
    return pieces;
  }

  std::string Fields::BodyFiles::piece(const std::size_t p) const
  {
    return numbered(n_pieces == 1 ? stem : stem + ".piece" + std::to_string(p), n_frames);
  }

  void Fields::write_bodies(const StepView &step)
  {
    for (BodyFiles &body : bodies)
    {
      write_pieces(step, body);
      if (step.structure.communicator().is_root())
      {
        if (body.is_joined)
          body.collection.add(step.state.time, numbered(body.stem, body.n_frames, ".pvtu"));
        else
          for (std::size_t p = 0; p < body.n_pieces; ++p)
            body.collection.add(step.state.time, body.piece(p), p);
      }
      ++body.n_frames;
    }
  }

  void Fields::write_pieces(const StepView &step, const BodyFiles &body) const
  {
    for (std::size_t p = 0; p < body.pieces.size(); ++p)
    {
      std::vector<std::vector<double>> displacements;
      for (const std::size_t k : body.pieces[p])
        displacements.push_back(displacement(step.reference, step.state, k));
      const std::string own = folder + body.piece(body.first_piece + p);
      const std::size_t first = body.pieces[p].front();
      if (body.pieces[p].size() == 1 && !body.is_joined)
      {
        step.structure[first].write_vtu(own, displacements.front());
        continue;
      }
      PartOfBody::Files files = {own};
      if (body.is_joined && body.first_piece + p == 0)
      {
        files.joined = folder + numbered(body.stem, body.n_frames, ".pvtu");
        for (std::size_t q = 0; q < body.n_pieces; ++q)
          files.pieces.push_back(body.piece(q));
      }
      std::vector<PartOfBody::Drawn> parts;
      for (std::size_t i = 0; i < displacements.size(); ++i)
        parts.push_back({part(step.structure, body.pieces[p][i]), &displacements[i]});
      part(step.structure, first)->write_vtu(files, parts);
    }
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
        if (e == 0 || part != parts.back())
        {
          lines.emplace_back();
          if (e > 0)
            lines.back().push_back(wires.size() - 1);
          numbers.push_back(w);
          parts.push_back(part);
          names.push_back(scene.wires[w].name);
        }
        for (unsigned int k = e == 0 ? 0 : 1; k <= subdivisions; ++k)
        {
          const double s = nodes[e] + (nodes[e + 1] - nodes[e]) * k / subdivisions;
          lines.back().push_back(wires.size());
          wires.push_back(sample(scene, structure, {Attachment::Kind::wire, w, s}));
        }
      }
    }
    wire_file = std::make_unique<VtuFile>(wires.size(), lines);
    wire_file->set(VtuFile::positions, places(wires));
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
                             lines.back().push_back(ends.size());
                             ends.push_back(sample(scene, structure, end));
                             link_of_end.push_back(i);
                           });
      }
      if (!moving)
        n_fixed_ends = ends.size();
    }
    link_file = std::make_unique<VtuFile>(ends.size(), lines);
    link_displacement = link_file->add(VtuFile::Location::points, "displacement", 3, "m");
    force = link_file->add(VtuFile::Location::points, "force", 1, "N, N m");
    gap = link_file->add(VtuFile::Location::points, "gap", 1, "m, rad");
    open = link_file->add(VtuFile::Location::points, "open", 1, "1");
    link_file->add(VtuFile::Location::cells, "name", names);
  }

  Fields::Sample Fields::sample(const Scene &scene, const SceneBodies &structure,
                                const Attachment &at) const
  {
    Sample result;
    result.place = structure.position(scene, at);
    for (unsigned int i = 0; i < 3; ++i)
      structure.motion(at, false, {i == 0 ? 1. : 0., i == 1 ? 1. : 0., i == 2 ? 1. : 0.}, 1.,
                       result.motion[i]);
    return result;
  }

  std::vector<float> Fields::displacements(const std::vector<Sample> &samples,
                                           const StepView &step) const
  {
    const BodyVectors &reference = step.reference.displacement, &U = step.state.U;
    std::vector<double> shares;
    shares.reserve(3 * samples.size());
    for (const Sample &sample : samples)
      for (const std::vector<Term> &terms : sample.motion)
        shares.push_back(evaluate(terms, reference) + evaluate(terms, U));
    step.structure.communicator().sum(shares);
    std::vector<float> values;
    values.reserve(3 * samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
      append({shares[3 * i], shares[3 * i + 1], shares[3 * i + 2]}, values);
    return values;
  }

  void Fields::record(const StepView &step)
  {
    // A step within rounding of its time is due.
    if (interval == 0. || step.state.time < next - 1e-9 * interval)
      return;
    next = step.state.time + interval;
    if (wire_file)
      wire_file->set(wire_displacement, displacements(wires, step));
    if (link_file)
    {
      move_ends(step);
      link_file->set(link_displacement, displacements(ends, step));
      set_links(step);
    }
    const auto write_files = [&]
    {
      write_bodies(step);
      if (!step.structure.communicator().is_root())
        return;
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

  void Fields::resume(InputArchive &archive, const StepView &step)
  {
    archive >> next;
    const auto load_collection = [&](PvdFile &collection)
    {
      std::size_t n = 0, length = 0;
      archive >> n >> length;
      if (step.structure.communicator().is_root())
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
    for (std::size_t e = n_fixed_ends; e < ends.size(); ++e)
    {
      const Link &link = step.scene.links[link_of_end[e]];
      const double s = step.constraints.position(step.constraints.index_of_link(link_of_end[e]),
                                                 step.state.time);
      const Attachment contact = SceneBodies::moved(link.to, s);
      // The `to` end is the last of its link. The sliding end is drawn at the contact.
      if (e + 1 == ends.size() || link_of_end[e + 1] != link_of_end[e])
        ends[e] = sample(step.scene, step.structure, contact);
      else
        ends[e].place = step.structure.position(step.scene, contact);
    }
  }

  void Fields::set_links(const StepView &step)
  {
    std::vector<float> forces, gaps, opened;
    for (const std::size_t link : link_of_end)
    {
      const std::size_t constraint = step.constraints.index_of_link(link);
      forces.push_back(static_cast<float>(step.state.multiplier[constraint]));
      gaps.push_back(static_cast<float>(step.state.distance[constraint]));
      opened.push_back(step.state.multiplier[constraint] == 0. ? 1.f : 0.f);
    }
    link_file->set(VtuFile::positions, places(ends));
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
