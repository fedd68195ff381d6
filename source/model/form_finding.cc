// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/found_droppers.h"

#include "model/form_finding.h"
#include "model/scene_part.h"
#include "scene/scene_values.h"
#include <taut/base/archive.h>

#include <algorithm>
#include <utility>

namespace taut
{
  namespace
  {
    /// Masses that springs and fixed links connect with a wire, directly or through other masses.
    std::vector<char> masses_at_wires(const Scene &scene)
    {
      std::vector<char> result(scene.masses.size(), 0);
      bool is_done = false;
      const auto connect = [&](const std::size_t a, const std::size_t b)
      {
        if (a == ground || b == ground || result[a] == result[b])
          return;
        result[a] = result[b] = 1;
        is_done = false;
      };
      const auto is_wire = [](const Attachment &at)
      { return at.kind == Attachment::Kind::wire || at.kind == Attachment::Kind::body; };
      for (const Link &link : scene.links)
        if (!link.moving() && link.any_place(is_wire))
          Link::visit_places(link,
                             [&](const Attachment &at)
                             {
                               if (at.kind == Attachment::Kind::mass)
                                 result[at.index] = 1;
                             });
      while (!is_done)
      {
        is_done = true;
        for (const Spring &spring : scene.springs)
          connect(spring.from, spring.to);
        for (const Link &link : scene.links)
        {
          std::size_t last = ground;
          Link::visit_places(link,
                             [&](const Attachment &at)
                             {
                               if (at.kind != Attachment::Kind::mass)
                                 return;
                               connect(last, at.index);
                               last = at.index;
                             });
        }
      }
      return result;
    }

    /// The loads of a scene during form finding.
    Scene while_built(Scene scene)
    {
      scene.loads.erase(std::remove_if(scene.loads.begin(), scene.loads.end(),
                                       [](const Load &load) { return !load.acts_while_built; }),
                        scene.loads.end());
      return without_sliding_contacts(std::move(scene));
    }

    /// All data that determine a form.
    std::string key(const Scene &part, const SolverParameters &parameters)
    {
      return values_of(part) + archived([&](OutputArchive &archive) { archive << parameters; });
    }
  } // namespace

  Scene without_sliding_contacts(Scene scene)
  {
    const std::vector<char> at_wires = masses_at_wires(scene);
    std::vector<Link> links;
    for (Link &link : scene.links)
      if (!link.moving())
        links.push_back(std::move(link));
      else if (link.from.kind == Attachment::Kind::mass && !at_wires[link.from.index])
      {
        Link hold;
        hold.name = link.name;
        hold.origin = link.origin;
        hold.to = link.from;
        hold.direction = link.direction;
        links.push_back(hold);
      }
    scene.links = std::move(links);
    return scene;
  }

  Scene find_lengths(Scene scene, const SolverParameters &parameters, const Communicator &processes,
                     SharedParts *const shared)
  {
    std::vector<Attachment> ends;
    for (const Link &link : scene.links)
      if (is_found(link))
        ends.insert(ends.end(), {link.from, link.to});
    if (ends.empty())
      return scene;
    // Only the connected part: other parts do not change a bit of the form.
    Scene part = connected_part(while_built(scene), ends).scene;
    std::vector<FoundDropper> droppers = found_droppers(part);
    const auto find = [&]
    {
      part.links.erase(std::remove_if(part.links.begin(), part.links.end(), is_found),
                       part.links.end());
      part.links.shrink_to_fit();
      return find_form(part, droppers, parameters, processes);
    };
    const DropperForm form = shared && processes.size() == 1 && part.bodies.empty()
                                 ? shared->forms.find(key(part, parameters), find)
                                 : find();

    std::size_t i = 0;
    for (Link &link : scene.links)
      if (is_found(link))
      {
        take_form(scene, droppers[i], form, i, link);
        link.form.find_length = link.form.find_direction = false;
        add_mass(link, scene);
        ++i;
      }
    return scene;
  }
} // namespace taut
