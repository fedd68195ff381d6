// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/entry_path.h"

#include "base/about_entry.h"
#include "scene/entries.h"
#include <taut/model/scene_bodies.h>

#include <algorithm>
#include <map>
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

  void SceneBodies::tie_parts(const std::string &name, const BodyParts &body,
                              const CellsOfParts &cells)
  {
    const BodyCells &all = body.division.body->cells();
    std::vector<std::tuple<unsigned int, unsigned int, unsigned int>> copies; // DoF, part, own DoF
    for (std::size_t p = 0; p < cells.size(); ++p)
    {
      std::vector<unsigned int> dofs;
      for (const unsigned int cell : cells[p])
        dofs.insert(dofs.end(), all.dofs.begin() + all.begin[cell],
                    all.dofs.begin() + all.begin[cell + 1]);
      std::sort(dofs.begin(), dofs.end());
      dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (!all.is_determined[dofs[i]])
          copies.emplace_back(dofs[i], p, i);
    }
    std::sort(copies.begin(), copies.end());
    for (std::size_t c = 1; c < copies.size(); ++c)
    {
      const unsigned int dof = std::get<0>(copies[c]);
      if (std::get<0>(copies[c - 1]) != dof)
        continue;
      CutConstraint constraint{name + " cut at DoF " + std::to_string(dof), false, {}};
      for (const auto &[copy, sign] : {std::make_pair(c - 1, 1.), std::make_pair(c, -1.)})
        if (const std::size_t k = body.index[std::get<1>(copies[copy])]; k != elsewhere)
        {
          constraint.terms.push_back({k, {}});
          constraint.terms.back().form.add(std::get<2>(copies[copy]), sign);
        }
      cuts.push_back(std::move(constraint));
    }
  }

  std::size_t SceneBodies::part_at(const std::size_t body, const Coordinates &place) const
  {
    const Partition::Division &division = custom_bodies[body].division;
    return division.body ? division.part[division.body->cell_at(place)] : 0;
  }

  std::size_t SceneBodies::index_at(const std::size_t body, const Coordinates &place) const
  {
    return custom_bodies[body].index[part_at(body, place)];
  }

  std::size_t SceneBodies::index_at_node(const std::size_t body, const unsigned int node) const
  {
    const Partition::Division &division = custom_bodies[body].division;
    return custom_bodies[body]
        .index[division.body ? division.part[division.body->cell_at_node(node)] : 0];
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
          }
          for (const Probe &probe : scene.probes)
            check(probe.point, probe.direction, probe.origin, "Point");
        });
  }
} // namespace taut
