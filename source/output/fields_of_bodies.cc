// SPDX-License-Identifier: LGPL-2.1-or-later
// The files of bodies that draw themselves.
#include "output/numbered_file.h"
#include <taut/base/exceptions.h>
#include <taut/output/fields.h>
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace taut
{
  namespace
  {
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
  } // namespace

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
} // namespace taut
