// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/courant_numbers.h"

#include "model/contact_mass.h"
#include "model/scene_constraints.h"
#include "time/contact_resolution.h"

#include <algorithm>

namespace taut
{
  namespace
  {
    /// Largest number of elements that a wave crosses in a step, for which the elements of a node
    /// without mass are a spring on which no scheme rings (measured on the bar that hits a wall,
    /// doc/accuracy.md).
    constexpr double most_courant_number = 4. * (1. + 1e-6);

    bool is_on_wire(const Link &link)
    {
      return link.from.kind == Attachment::Kind::wire || link.to.kind == Attachment::Kind::wire;
    }

    /// The exactly rigid unilateral links, if nodes without mass suit all of them: stops on bars or
    /// strings, two elements apart, whose waves are slow enough; otherwise none.
    std::vector<std::size_t> find_springy_stops(const Scene &scene, const double step)
    {
      const CourantNumbers courant(scene, step);
      std::vector<std::size_t> stops;
      std::vector<std::pair<std::size_t, std::size_t>> nodes; // wire and node
      for (std::size_t i = 0; i < scene.links.size(); ++i)
      {
        const Link &link = scene.links[i];
        if (!link.unilateral() || !link.rigid() || link.form.axial_stiffness != 0.)
          continue;
        if (link.kind != LinkKind::stop || link.turns || !is_on_wire(link))
          return {};
        for (const Attachment *end : {&link.from, &link.to})
        {
          if (end->kind != Attachment::Kind::wire)
            continue;
          if (link.rotational || bends(scene.wires[end->index], link.direction) ||
              !(courant.at(link, *end) <= most_courant_number) ||
              courant.n_elements(end->index) < 2)
            return {};
          nodes.emplace_back(end->index, courant.node(*end));
        }
        stops.push_back(i);
      }
      std::sort(nodes.begin(), nodes.end());
      const bool are_close =
          std::adjacent_find(nodes.begin(), nodes.end(),
                             [](const auto &a, const auto &b) {
                               return a.first == b.first && b.second - a.second < 2;
                             }) != nodes.end();
      return are_close ? std::vector<std::size_t>() : stops;
    }
  } // namespace

  bool is_massless(const Link &link)
  {
    return link.contact_mass != ContactMass::stays && is_on_wire(link);
  }

  void redistribute_contact_mass(Scene &scene, const SolverParameters &parameters,
                                 const double step)
  {
    const std::vector<std::size_t> stops = find_springy_stops(scene, step);
    if (stops.empty())
      return;
    Scene lighter = scene;
    for (const std::size_t i : stops)
      lighter.links[i].contact_mass = ContactMass::keeps_total;
    // Links with a stiffness may act as rigid, too, and so may a node to which a mass is joined:
    // this depends on the bodies.
    const SceneBodies structure(lighter);
    const Constraints constraints = scene_constraints(lighter, structure);
    const ContactResolution resolution(structure, constraints, parameters, step, step, 0.);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (resolution.acts_as_rigid(i))
        return;
    scene = std::move(lighter);
  }
} // namespace taut
