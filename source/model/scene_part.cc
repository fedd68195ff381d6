// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/scene_part.h"
#include "base/groups.h"

#include <utility>

namespace taut
{
  namespace
  {
    using Kind = Attachment::Kind;

    /// Wires, masses and bodies in one count, with sets of them that are connected.
    class Connections
    {
    public:
      explicit Connections(const Scene &scene)
          : n_wires(scene.wires.size()), n_masses(scene.masses.size()),
            connected(n_wires + n_masses + scene.bodies.size())
      {
        for (const Spring &spring : scene.springs)
          if (spring.from != ground && spring.to != ground)
            connected.join(n_wires + spring.from, n_wires + spring.to);
        for (const Link &link : scene.links)
          if (!link.moving())
          {
            const Attachment *last = nullptr;
            Link::visit_places(link,
                               [&](const Attachment &at)
                               {
                                 if (at.kind == Kind::ground)
                                   return;
                                 if (last)
                                   connected.join(number(*last), number(at));
                                 last = &at;
                               });
          }
        for (const SurfaceContact &contact : scene.contacts)
          if (contact.obstacle.shape == ObstacleSetting::Shape::none)
            connected.join(n_wires + n_masses + contact.slave.body,
                           n_wires + n_masses + contact.master.body);
      }

      std::size_t number(const Attachment &end) const
      {
        return end.index + (end.kind == Kind::wire   ? 0
                            : end.kind == Kind::mass ? n_wires
                                                     : n_wires + n_masses);
      }

      /// Number of the set that each item is in.
      std::vector<std::size_t> sets() { return connected.numbers(); }

    private:
      std::size_t n_wires, n_masses;
      Groups connected;
    };

    /// Copies the items that are in the part, and notes their numbers there.
    template <typename Item>
    void take(std::vector<Item> &all, const std::vector<char>::const_iterator is_inside,
              std::vector<Item> &items, std::vector<std::size_t> &numbers)
    {
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        numbers.push_back(is_inside[i] ? items.size() : ground);
        if (is_inside[i])
          items.push_back(std::move(all[i]));
      }
    }
  } // namespace

  Attachment ScenePart::inside(Attachment end) const
  {
    if (end.kind != Kind::ground)
      end.index = (end.kind == Kind::wire ? wire : end.kind == Kind::mass ? mass : body)[end.index];
    return end;
  }

  ScenePart connected_part(Scene scene, const std::vector<Attachment> &points)
  {
    Connections connections(scene);
    const std::vector<std::size_t> set = connections.sets();
    std::vector<char> set_is_inside(set.size(), 0), is_inside(set.size(), 0);
    for (const Attachment &point : points)
      if (point.kind != Kind::ground)
        set_is_inside[set[connections.number(point)]] = 1;
    for (std::size_t i = 0; i < set.size(); ++i)
      is_inside[i] = set_is_inside[set[i]];

    ScenePart part;
    Scene &inner = part.scene;
    inner.gravity = scene.gravity;
    inner.start = scene.start;
    auto own = is_inside.cbegin();
    take(scene.wires, own, inner.wires, part.wire);
    take(scene.masses, own += scene.wires.size(), inner.masses, part.mass);
    take(scene.bodies, own += scene.masses.size(), inner.bodies, part.body);
    inner.links.reserve(scene.links.size());

    const auto has = [&](const Attachment &end)
    { return end.kind != Kind::ground && is_inside[connections.number(end)]; };
    for (Support &support : scene.supports)
      if ((support.wire = part.wire[support.wire]) != ground)
        inner.supports.push_back(std::move(support));
    for (PointMass &mass : scene.point_masses)
      if ((mass.wire = part.wire[mass.wire]) != ground)
        inner.point_masses.push_back(std::move(mass));
    for (Spring &spring : scene.springs)
    {
      for (std::size_t *const end : {&spring.from, &spring.to})
        if (*end != ground)
          *end = part.mass[*end];
      if (spring.from != ground || spring.to != ground)
        inner.springs.push_back(std::move(spring));
    }
    for (Link &link : scene.links)
      if (!link.moving() && link.any_place(has))
      {
        Link::visit_places(link, [&](Attachment &at) { at = part.inside(at); });
        inner.links.push_back(std::move(link));
      }
    for (SurfaceContact &contact : scene.contacts)
      if ((contact.slave.body = part.body[contact.slave.body]) != ground)
      {
        if (contact.obstacle.shape == ObstacleSetting::Shape::none)
          contact.master.body = part.body[contact.master.body];
        inner.contacts.push_back(std::move(contact));
      }
    for (Load &load : scene.loads)
      if (has(load.target))
      {
        load.target = part.inside(load.target);
        inner.loads.push_back(std::move(load));
      }
    return part;
  }

  Scene wire_part(const Scene &scene, const std::size_t wire)
  {
    Scene part;
    part.gravity = scene.gravity;
    part.start = scene.start;
    part.wires = {scene.wires[wire]};
    const auto is_on_wire = [wire](const Attachment &end)
    { return end.kind == Kind::wire && end.index == wire; };
    const auto inside = [&](const Attachment &end) {
      return is_on_wire(end) ? Attachment{Kind::wire, 0, end.position} : Attachment();
    };
    for (const Support &support : scene.supports)
      if (support.wire == wire)
      {
        part.supports.push_back(support);
        part.supports.back().wire = 0;
      }
    for (const PointMass &mass : scene.point_masses)
      if (mass.wire == wire)
      {
        part.point_masses.push_back(mass);
        part.point_masses.back().wire = 0;
      }
    for (const Load &load : scene.loads)
      if (is_on_wire(load.target))
      {
        part.loads.push_back(load);
        part.loads.back().target = inside(load.target);
      }
    for (const Link &link : scene.links)
      if (link.contact_mass != ContactMass::stays && (is_on_wire(link.from) || is_on_wire(link.to)))
      {
        part.links.push_back(link);
        part.links.back().from = inside(link.from);
        part.links.back().to = inside(link.to);
      }
    return part;
  }
} // namespace taut
