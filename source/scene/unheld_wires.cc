// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/unheld_wires.h"
#include "base/text.h"

#include <algorithm>

namespace taut
{
  std::vector<std::string> warnings_of_unheld_wires(const Scene &scene)
  {
    std::vector<std::string> result;
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      const Wire &wire = scene.wires[w];
      if (!(wire.tension > 0.) || wire.transverse == TransverseKind::none ||
          wire.foundation_stiffness > 0.)
        continue;
      const bool has_support = std::any_of(
          scene.supports.begin(), scene.supports.end(),
          [&](const Support &support)
          { return support.wire == w && component_of(support.motion) != WireMotion::axial; });
      const auto is_here = [&](const Attachment &end)
      { return end.kind == Attachment::Kind::wire && end.index == w; };
      const bool has_link =
          std::any_of(scene.links.begin(), scene.links.end(),
                      [&](const Link &link)
                      { return !link.moving() && (is_here(link.from) || is_here(link.to)); });
      if (!has_support && !has_link)
        result.push_back(to_text("wire '", wire.name, "' has a tension of ", wire.tension,
                                 " N and neither a support nor a link across it: it falls as a "
                                 "whole. Hold its ends, with a support at 0, ",
                                 wire.length(), " m"));
    }
    return result;
  }
} // namespace taut
