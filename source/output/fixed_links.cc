// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/fixed_links.h"

namespace taut
{
  std::vector<FixedLink> fixed_links(const Scene &scene, const Constraints &rows)
  {
    std::vector<FixedLink> result;
    for (const bool turns : {false, true})
      for (std::size_t l = 0; l < scene.links.size(); ++l)
        if (const Link &link = scene.links[l]; !link.moving() && link.turns == turns)
          result.push_back({l, link.name, link.unilateral(), link.rotational});
    // Those of a System are known by their rows alone.
    for (std::size_t i = 0; i < rows.size() && !rows.slides(i); ++i)
      if (rows[i].is_link() && rows[i].link >= scene.links.size())
        result.push_back({rows[i].link, rows[i].name, rows[i].cone.may_open(), rows[i].rotational});
    return result;
  }
} // namespace taut
