// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/entry_path.h"

#include "base/about_entry.h"
#include "base/dealt_numbers.h"
#include "base/text.h"
#include "scene/entries.h"
#include <taut/model/scene_bodies.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace taut
{
  namespace
  {
    LinearForm displacement(const Substructure &body, const Attachment &at,
                            const Coordinates &direction)
    {
      LinearForm form = body.displacement(at.place, direction);
      if (form.index.empty())
        throw UserError("body '" + body.name() +
                        "' has no motion there along the direction; change the direction, or "
                        "instead of a ball joint take joints along those that it has");
      return form;
    }
  } // namespace

  void SceneBodies::list_custom_bodies(const Scene &scene, const Partition &partition,
                                       const std::vector<unsigned int> &owner,
                                       std::vector<NewBody> &list, std::vector<CellsOfParts> &cells)
  {
    custom_bodies.resize(scene.bodies.size());
    cells.resize(scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    {
      const CustomBody &body = scene.bodies[i];
      const BodySetting setting{body.name, body.origin, scene.gravity};
      if (i < partition.bodies.size() && partition.bodies[i].body)
      {
        std::vector<unsigned int> part;
        cells[i] = number_parts(partition, i, part);
        for (std::size_t p = 0; p < part.size(); ++p)
        {
          custom_bodies[i].index.push_back(list.size());
          list.push_back({body.name, owner[part[p]],
                          [this, &scene, i, p, setting, &own = cells[i][p]]
                          {
                            auto made = custom_bodies[i].division.body->make_part(setting, own);
                            add_loads(scene, i, p, *made);
                            return made;
                          }});
        }
        continue;
      }
      custom_bodies[i].index.push_back(list.size());
      list.push_back({body.name, owner[owner.size() - scene.bodies.size() + i],
                      [this, &scene, &body, i, setting]
                      {
                        std::unique_ptr<Substructure> made = body.type->make(setting);
                        if (!made)
                          throw EntryError(body.origin,
                                           "its type '" + body.type_name + "' made no body");
                        add_loads(scene, i, 0, *made);
                        return made;
                      }});
    }
  }

  /// Numbers the parts of a divided body anew, without those that have no cell of it, with the old
  /// number of each in @p part.
  SceneBodies::CellsOfParts SceneBodies::number_parts(const Partition &partition,
                                                      const std::size_t body,
                                                      std::vector<unsigned int> &part)
  {
    Partition::Division &division = custom_bodies[body].division;
    division = partition.bodies[body];
    std::map<unsigned int, unsigned int> position;
    for (const unsigned int p : division.part)
      position.insert({p, 0});
    for (const unsigned int p : division.parts)
      position.insert({p, 0});
    for (auto &[p, at] : position)
    {
      at = part.size();
      part.push_back(p);
    }
    CellsOfParts cells(part.size());
    for (std::size_t c = 0; c < division.part.size(); ++c)
    {
      division.part[c] = position.at(division.part[c]);
      cells[division.part[c]].push_back(c);
    }
    return cells;
  }

  namespace
  {
    /// DoFs of each part that can be tied, ascending: number of the DoF, part, position in the
    /// part.
    std::vector<std::tuple<unsigned int, unsigned int, unsigned int>>
    free_dofs(const BodyCells &all, const std::vector<std::vector<unsigned int>> &cells)
    {
      std::vector<std::tuple<unsigned int, unsigned int, unsigned int>> result;
      std::vector<unsigned int> dofs;
      for (std::size_t p = 0; p < cells.size(); ++p)
      {
        dofs.clear();
        for (const unsigned int cell : cells[p])
          dofs.insert(dofs.end(), all.dofs.begin() + all.begin[cell],
                      all.dofs.begin() + all.begin[cell + 1]);
        std::sort(dofs.begin(), dofs.end());
        dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (!all.is_determined[dofs[i]])
            result.emplace_back(all.numbers.empty() ? dofs[i] : all.numbers[dofs[i]], p, i);
      }
      std::sort(result.begin(), result.end());
      return result;
    }

    auto key(const std::size_t body, const Coordinates &place)
    {
      return std::make_tuple(body, place.x, place.y, place.z);
    }
  } // namespace

  /// A cut between two parts, whose number is the next one.
  void SceneBodies::add_cut(const std::string &name, const BodyParts &body, const unsigned int dof,
                            const std::array<PartWithDof, 2> &sides)
  {
    CutConstraint constraint{name + " cut at DoF " + std::to_string(dof), false, n_cuts_of_all++};
    for (const bool is_second : {false, true})
      if (const std::size_t k = body.index[sides[is_second].part]; k != elsewhere)
      {
        constraint.terms.push_back({k, {}});
        constraint.terms.back().form.add(sides[is_second].own_dof, is_second ? -1. : 1.);
      }
    cuts.push_back(std::move(constraint));
  }

  void SceneBodies::tie_parts(const std::string &name, const BodyParts &body,
                              const CellsOfParts &cells)
  {
    const auto copies = free_dofs(body.division.body->cells(), cells);
    for (std::size_t c = 1; c < copies.size(); ++c)
    {
      const auto &[dof, part, own_dof] = copies[c];
      const auto &[dof_before, part_before, own_dof_before] = copies[c - 1];
      if (dof == dof_before)
        add_cut(name, body, dof, {{{part_before, own_dof_before}, {part, own_dof}}});
    }
  }

  /// The rank to which the number of a DoF leads collects the parts with the DoF, numbers the cuts
  /// between them, and tells the ranks of these parts.
  void SceneBodies::tie_distributed_parts(const std::string &name, const BodyParts &body,
                                          const CellsOfParts &cells)
  {
    const DivisibleBody &divided = *body.division.body;
    const Communicator processes = divided.processes();
    const DealtNumbers dealt(processes, divided.cells().n_dofs());

    const auto copies = free_dofs(divided.cells(), cells);
    DealtNumbers::Messages sent;
    for (const auto &[dof, part, own_dof] : copies)
    {
      std::vector<unsigned int> &list = sent[dealt.rank_of(dof)];
      list.insert(list.end(), {dof, part});
    }
    std::map<unsigned int, std::map<unsigned int, unsigned int>> parts_of; // of DoFs, with ranks
    for (const auto &[rank, list] : dealt.exchange(sent))
      for (std::size_t e = 0; e < list.size(); e += 2)
        parts_of[list[e]][list[e + 1]] = rank;

    std::size_t n_own = 0;
    for (const auto &[dof, parts] : parts_of)
      n_own += parts.size() - 1;
    std::vector<std::size_t> n_of_rank;
    processes.gather(n_own, n_of_rank);
    std::size_t first =
        std::accumulate(n_of_rank.begin(), n_of_rank.begin() + processes.rank(), std::size_t(0));
    DealtNumbers::Messages told; // DoF, number of its first cut, number of parts, parts
    for (const auto &[dof, parts] : parts_of)
    {
      std::set<unsigned int> ranks;
      for (const auto &[part, rank] : parts)
        ranks.insert(rank);
      for (const unsigned int rank : ranks)
      {
        if (parts.size() == 1)
          continue;
        std::vector<unsigned int> &list = told[rank];
        list.insert(list.end(), {dof, static_cast<unsigned int>(first),
                                 static_cast<unsigned int>(parts.size())});
        for (const auto &[part, other] : parts)
          list.push_back(part);
      }
      first += parts.size() - 1;
    }

    const auto position = [&](const unsigned int dof, const unsigned int part)
    {
      const auto at =
          std::lower_bound(copies.begin(), copies.end(), std::make_tuple(dof, part, 0u));
      return at != copies.end() && std::get<0>(*at) == dof && std::get<1>(*at) == part
                 ? std::get<2>(*at)
                 : 0u;
    };
    const std::size_t before = n_cuts_of_all;
    for (const auto &[rank, list] : dealt.exchange(told))
      for (std::size_t e = 0; e < list.size(); e += 3 + list[e + 2])
      {
        const unsigned int dof = list[e], *const parts = &list[e + 3];
        n_cuts_of_all = before + list[e + 1];
        for (unsigned int p = 1; p < list[e + 2]; ++p)
          if (body.index[parts[p - 1]] != elsewhere || body.index[parts[p]] != elsewhere)
            add_cut(name, body, dof,
                    {{{parts[p - 1], position(dof, parts[p - 1])},
                      {parts[p], position(dof, parts[p])}}});
          else
            ++n_cuts_of_all;
      }
    n_cuts_of_all = std::accumulate(n_of_rank.begin(), n_of_rank.end(), before);
  }

  /// The parts of distributed bodies at the places of the scene. Where several ranks have a place,
  /// at a node between them, the first part counts.
  void SceneBodies::find_places(const Scene &scene)
  {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    std::vector<double> parts; // with another sign, so that the largest is that of the first part
    const auto note = [&](const Attachment &at)
    {
      if (at.kind != Attachment::Kind::body)
        return;
      const Partition::Division &division = custom_bodies[at.index].division;
      if (!division.body || !division.body->is_distributed() ||
          !part_of_place.emplace(key(at.index, at.place), parts.size()).second)
        return;
      parts.push_back(-nowhere);
      try
      {
        parts.back() = -static_cast<double>(division.part[division.body->cell_at(at.place)]);
      }
      catch (const UserError &) // other ranks may have it
      {
      }
    };
    for (const Link &link : scene.links)
      Link::visit_places(link, note);
    for (const Load &load : scene.loads)
      note(load.target);
    for (const Probe &probe : scene.probes)
      note(probe.point);
    if (parts.empty())
      return;
    communicator().max(parts);
    for (auto &[place, part] : part_of_place)
      if (const double found = parts[*part]; std::isfinite(found))
        part = static_cast<std::size_t>(-found);
      else
        part = std::nullopt;
  }

  unsigned int SceneBodies::n_sharing_ranks() const
  {
    for (const BodyParts &body : custom_bodies)
      if (body.division.body && body.division.body->is_distributed())
        return body.division.body->processes().size();
    return 0;
  }

  std::size_t SceneBodies::part_at(const std::size_t body, const Coordinates &place) const
  {
    const Partition::Division &division = custom_bodies[body].division;
    if (!division.body)
      return 0;
    if (!division.body->is_distributed())
      return division.part[division.body->cell_at(place)];
    const auto known = part_of_place.find(key(body, place));
    if (known == part_of_place.end() || !known->second)
      throw UserError(to_text("the point ", place.x, ' ', place.y,
                              division.body->cells().dim == 3 ? to_text(' ', place.z) : "",
                              " is not on the body"));
    return *known->second;
  }

  std::size_t SceneBodies::index_at(const std::size_t body, const Coordinates &place) const
  {
    return custom_bodies[body].index[part_at(body, place)];
  }

  std::size_t SceneBodies::index_at_node(const std::size_t body, const unsigned int node) const
  {
    const Partition::Division &division = custom_bodies[body].division;
    if (!division.body)
      return custom_bodies[body].index[0];
    const std::size_t cell = division.body->cell_at_node(node);
    return cell < division.part.size() ? custom_bodies[body].index[division.part[cell]] : elsewhere;
  }

  void SceneBodies::add_loads(const Scene &scene, const std::size_t body, const std::size_t part,
                              Substructure &made) const
  {
    for (const Load &load : scene.loads)
    {
      if (load.target.kind != Attachment::Kind::body || load.target.index != body)
        continue;
      const LinearForm form =
          about_entry(entry_path(load.origin, "On"),
                      [&]
                      {
                        return part_at(body, load.target.place) == part
                                   ? displacement(made, load.target, load.direction)
                                   : LinearForm();
                      });
      if (form.index.empty())
        continue;
      const double s = is_on_cable(scene, load.target) ? load.target.place.x : 0.;
      if (load.magnitude.depends_on_time())
        made.add_force(form, [f = load.magnitude, s](const double t) { return f(s, t); });
      else
        made.add_force(form, load.magnitude(s, 0.));
    }
  }

  /// Checks that all points at custom bodies are on the bodies and move, on all ranks alike.
  void SceneBodies::check_places(const Scene &scene) const
  {
    const auto check = [&](const Attachment &end, const Coordinates &direction,
                           const std::string &origin, const std::string &entry)
    {
      if (end.kind == Attachment::Kind::body)
        about_entry(entry_path(origin, entry),
                    [&]
                    {
                      const std::size_t k = index_at(end.index, end.place);
                      if (k != elsewhere)
                        displacement((*this)[k], end, direction);
                    });
    };
    communicator().agree(
        [&]
        {
          for (const Link &link : scene.links)
          {
            check(link.from, link.direction, link.origin, "From");
            check(link.to, link.direction, link.origin, "To");
            for (const Attachment &ring : link.through)
              check(ring, link.direction, link.origin, "Through");
          }
          for (const Probe &probe : scene.probes)
            check(probe.point, probe.direction, probe.origin, "Point");
        });
  }
} // namespace taut
