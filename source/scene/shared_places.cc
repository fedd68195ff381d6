// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/shared_places.h"
#include "scene/places_by_x.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace taut
{
  namespace
  {
    /// Largest part of a place that missing digits may change: an intended short element is longer.
    /// Largest part of the length of a wire that is too short for a useful element.
    constexpr double part_of_place = 1e-6, part_of_length = 1e-8;
  } // namespace

  double same_place(const Wire &wire)
  {
    constexpr double part_of_element = 1e-6;
    return part_of_element * std::min(wire.element_size, wire.length());
  }

  namespace
  {
    /// Calls @p visit with fixed ends of links and targets of point loads.
    template <typename Visit>
    void visit_nodes(Scene &scene, const Visit &visit)
    {
      for (Link &link : scene.links)
      {
        if (link.moving())
          visit(link.from);
        else
          Link::visit_places(link, visit);
      }
      for (Load &load : scene.loads)
        if (load.kind == Load::Kind::point)
          visit(load.target);
    }

    void divide_bodies(Scene &scene)
    {
      std::vector<std::vector<double>> places(scene.bodies.size());
      visit_nodes(scene,
                  [&](const Attachment &end)
                  {
                    if (end.kind == Attachment::Kind::body && end.index < places.size())
                      places[end.index].push_back(end.place.x);
                  });
      for (std::size_t i = 0; i < places.size(); ++i)
        if (const auto *const type = dynamic_cast<const PlacesByX *>(scene.bodies[i].type.get()))
          if (auto divided = type->divided(places[i]))
            scene.bodies[i].type = std::move(divided);
    }

    /// The places inside each wire that are nodes of its grid.
    std::vector<std::vector<double *>> places_of_nodes(Scene &scene)
    {
      std::vector<std::vector<double *>> places(scene.wires.size());
      const auto add_place = [&](const std::size_t wire, double &s)
      {
        if (wire < places.size() && s >= 0. && s <= scene.wires[wire].length())
          places[wire].push_back(&s);
      };
      const auto add = [&](Attachment &end)
      {
        if (end.kind == Attachment::Kind::wire)
          add_place(end.index, end.position);
      };
      for (std::size_t w = 0; w < scene.wires.size(); ++w)
        for (TensionChange &change : scene.wires[w].tension_changes)
        {
          add_place(w, change.from);
          add_place(w, change.to);
        }
      for (Support &support : scene.supports)
        for (double &s : support.positions)
          add_place(support.wire, s);
      for (PointMass &mass : scene.point_masses)
        for (double &s : mass.positions)
          add_place(mass.wire, s);
      visit_nodes(scene, add);
      return places;
    }
  } // namespace

  void share_places(Scene &scene)
  {
    std::vector<std::vector<double *>> places = places_of_nodes(scene);
    for (std::size_t w = 0; w < places.size(); ++w)
    {
      const double length = scene.wires[w].length(), same = same_place(scene.wires[w]);
      const auto move = [&](double &s, const double to)
      {
        // The grid takes places that differ by rounding for one node anyway.
        const double distance = std::fabs(s - to), rounding = 1e-12 * length;
        const bool are_one =
            distance <= std::min(same, std::max(part_of_place * to, part_of_length * length));
        if (are_one && distance > rounding)
          s = to;
        return are_one || distance <= rounding;
      };
      std::sort(places[w].begin(), places[w].end(),
                [](const double *p, const double *q) { return *p < *q; });
      double first = 0.;
      for (double *const s : places[w])
        if (!move(*s, length) && !move(*s, first))
          first = *s;
    }
    divide_bodies(scene);
  }
} // namespace taut
