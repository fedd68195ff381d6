// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "mechanism/mechanism.h"
#include "model/ranks_of_parts.h"
#include "model/scene_part.h"
#include "model/shared_parts.h"
#include "scene/entries.h"
#include "scene/scene_values.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/model/scene_bodies.h>
#include <taut/substructure/body_traits.h>
#include <taut/wire/wire_component.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

namespace taut
{
  namespace
  {
    /// A piece of the wire of a wire_part(), new or from the shared parts.
    std::shared_ptr<Substructure> make_piece(const Scene &part, const WireMotion motion,
                                             const std::vector<double> &nodes,
                                             const std::size_t first, const std::size_t last,
                                             SharedParts *const shared)
    {
      const auto make = [&]() -> std::shared_ptr<Substructure>
      { return std::make_shared<WireComponent>(part, 0, motion, nodes, first, last); };
      if (!shared)
        return make();
      const int kind = static_cast<int>(motion);
      const std::string cut =
          archived([&](OutputArchive &archive) { archive << kind << nodes << first << last; });
      return shared->wires.find(values_of(part) + cut, make);
    }
  } // namespace

  SceneBodies::SceneBodies(const Structure &bodies) : Structure(bodies)
  {
    custom_bodies.resize(all_bodies().size());
    for (BodyParts &body : custom_bodies)
      body.index = {elsewhere};
    for (std::size_t k = 0; k < size(); ++k)
      custom_bodies[number(k)].index = {k};
  }

  SceneBodies::SceneBodies(const Scene &scene, const Partition &partition,
                           const Communicator &processes, SharedParts *const shared)
      : Structure(processes), wires(scene.wires.size()), mechanism_of_mass(scene.masses.size())
  {
    const auto mechanisms = connected_masses(scene);
    const std::vector<unsigned int> owner =
        ranks_of_parts(scene, partition, mechanisms, processes.size());
    // Places in the list at first, then indices.
    std::vector<NewBody> list;
    for (std::size_t i = 0; i < scene.wires.size(); ++i)
      list_wire(scene, i, partition.wires[i], owner, shared, list);
    for (std::size_t m = 0; m < mechanisms.size(); ++m)
    {
      for (const std::size_t mass : mechanisms[m])
        mechanism_of_mass[mass] = list.size();
      list.push_back({Mechanism::name_of(scene, mechanisms[m]), owner[partition.n_parts + m],
                      [&scene, &members = mechanisms[m]]
                      { return std::make_unique<Mechanism>(scene, members); }});
    }
    std::vector<CellsOfParts> cells;
    list_custom_bodies(scene, partition, owner, list, cells);
    find_places(scene);

    const std::vector<std::size_t> index = add(list);
    const auto find = [&](std::vector<std::size_t> &places)
    {
      for (std::size_t &at : places)
        at = index[at];
    };
    for (WireParts &parts : wires)
      for (std::vector<std::size_t> &component : parts.components)
        find(component);
    find(mechanism_of_mass);
    for (BodyParts &body : custom_bodies)
      find(body.index);

    for (std::size_t i = 0; i < scene.wires.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        tie_pieces(scene, i, wire_components[c], wires[i].components[c]);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (const DivisibleBody *const body = custom_bodies[i].division.body.get())
        body->is_distributed()
            ? tie_distributed_parts(scene.bodies[i].name, custom_bodies[i], cells[i])
            : tie_parts(scene.bodies[i].name, custom_bodies[i], cells[i]);
    check_places(scene);
  }

  /// The pieces of a wire, for each component.
  void SceneBodies::list_wire(const Scene &scene, const std::size_t wire,
                              const std::vector<Partition::Piece> &pieces,
                              const std::vector<unsigned int> &owner, SharedParts *const shared,
                              std::vector<NewBody> &list)
  {
    const Wire &data = scene.wires[wire];
    axes.push_back({});
    rotation_axes.push_back({});
    for (unsigned int c = 0; c < 3; ++c)
    {
      axes.back()[c] = data.axis(wire_components[c]);
      rotation_axes.back()[c] = data.rotation_axis(wire_components[c]);
    }
    lengths.push_back(data.length());
    const auto nodes = std::make_shared<const std::vector<double>>(grid(scene, wire));
    const auto part = std::make_shared<const Scene>(wire_part(scene, wire));
    for (const Partition::Piece &piece : pieces)
    {
      wires[wire].begins.push_back((*nodes)[piece.first]);
      wires[wire].part.push_back(piece.part);
    }
    for (unsigned int c = 0; c < 3; ++c)
      for (std::size_t p = 0; data.has(wire_components[c]) && p < pieces.size(); ++p)
      {
        const WireMotion motion = wire_components[c];
        const std::size_t first = pieces[p].first,
                          last = p + 1 < pieces.size() ? pieces[p + 1].first : nodes->size() - 1;
        wires[wire].components[c].push_back(list.size());
        list.push_back({WireComponent::name_of(scene, wire, motion), owner[pieces[p].part],
                        [=] { return make_piece(*part, motion, *nodes, first, last, shared); }});
      }
  }

  /// The constraints of the cuts between the pieces of a component of a wire.
  void SceneBodies::tie_pieces(const Scene &scene, const std::size_t wire, const WireMotion motion,
                               const std::vector<std::size_t> &indices)
  {
    const bool has_slopes =
        motion != WireMotion::axial && scene.wires[wire].transverse == TransverseKind::beam;
    for (std::size_t p = 1; p < indices.size(); ++p)
      for (unsigned int k = 0; k < (has_slopes ? 2u : 1u); ++k)
      {
        CutConstraint constraint{to_text(WireComponent::name_of(scene, wire, motion),
                                         k == 1 ? " slope" : "", " cut at ", wires[wire].begins[p],
                                         " m"),
                                 k == 1};
        for (const bool is_left : {true, false})
          if (const std::size_t body = indices[is_left ? p - 1 : p]; body != elsewhere)
          {
            const auto &piece = static_cast<const WireComponent &>((*this)[body]);
            constraint.terms.push_back({body, {}});
            constraint.terms.back().form.add((is_left ? piece.last_dof() : piece.first_dof()) + k,
                                             is_left ? 1. : -1.);
          }
        constraint.number = n_cuts_of_all++;
        cuts.push_back(std::move(constraint));
      }
  }

  std::size_t SceneBodies::piece(const WireParts &parts, const double s) const
  {
    const double same = 1e-12 * lengths[&parts - wires.data()];
    const auto after = std::upper_bound(parts.begins.begin() + 1, parts.begins.end(), s + same);
    return after - parts.begins.begin() - 1;
  }

  unsigned int SceneBodies::part(const std::size_t wire, const double s) const
  {
    return wires[wire].part[piece(wires[wire], s)];
  }

  void SceneBodies::append_motion(const Attachment &point, const bool rotational,
                                  const Coordinates &direction, const double factor,
                                  const bool derivative, std::vector<Term> &terms) const
  {
    const auto append = [&](const std::size_t k, const double f, const LinearForm &of_body)
    {
      if (of_body.index.empty())
        return;
      terms.push_back({k, of_body});
      for (double &v : terms.back().form.value)
        v *= f;
    };
    LinearForm form;
    if (point.kind == Attachment::Kind::mass)
    {
      const std::size_t k = mechanism_of_mass[point.index];
      if (k == elsewhere)
        return;
      static_cast<const Mechanism &>((*this)[k])
          .motion(point.index, rotational, direction, form, point.place);
      append(k, factor, form);
    }
    else if (point.kind == Attachment::Kind::body)
    {
      const std::size_t k = rotational ? elsewhere : index_at(point.index, point.place);
      if (k == elsewhere)
        return;
      if (!derivative)
        return append(k, factor, (*this)[k].displacement(point.place, direction));
      if (const auto *body = dynamic_cast<const SlenderBody *>(&(*this)[k]))
        append(k, factor, body->slope(point.place.x, direction));
    }
    else if (point.kind == Attachment::Kind::wire)
    {
      const WireParts &parts = wires[point.index];
      const auto wire = [&](const std::size_t k) -> const WireComponent &
      { return static_cast<const WireComponent &>((*this)[k]); };
      const std::size_t p = piece(parts, point.position);
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = parts.index(c, p);
        const double part = dot(direction, (rotational ? rotation_axes : axes)[point.index][c]);
        if (k == elsewhere || part == 0.)
          continue;
        if (rotational || derivative)
          wire(k).slope_at(point.position, form);
        else
          wire(k).value_at(point.position, form);
        append(k, factor * part, form);
      }
    }
  }

  Attachment SceneBodies::moved(const Attachment &point, const double position)
  {
    Attachment result = point;
    result.position = position;
    if (point.kind == Attachment::Kind::body)
      result.place.x = position;
    return result;
  }

  Coordinates SceneBodies::position(const Scene &scene, const Attachment &point) const
  {
    if (point.kind != Attachment::Kind::body)
      return place(scene, point);
    const std::size_t k = index_at(point.index, point.place);
    double sums[] = {0., 0., 0.};
    if (k != elsewhere)
    {
      const Coordinates at = (*this)[k].position(point.place);
      for (unsigned int c = 0; c < 3; ++c)
        sums[c] = at[c];
    }
    communicator().sum(sums, 3);
    return {sums[0], sums[1], sums[2]};
  }

  void SceneBodies::motion(const std::size_t wire, const double s, const WireMotion motion,
                           std::vector<Term> &terms) const
  {
    const auto component =
        std::find(std::begin(wire_components), std::end(wire_components), component_of(motion));
    const std::size_t k =
        wires[wire].index(component - std::begin(wire_components), piece(wires[wire], s));
    if (k == elsewhere)
      return;
    LinearForm form;
    const auto &body = static_cast<const WireComponent &>((*this)[k]);
    if (is_slope(motion))
      body.slope_at(s, form);
    else
      body.value_at(s, form);
    terms.push_back({k, std::move(form)});
  }
} // namespace taut
