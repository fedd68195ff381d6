// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fixed_links_h
#define taut_fixed_links_h

#include <taut/interface/constraints.h>
#include <taut/scene/scene.h>

#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /// A link that does not slide.
  struct FixedLink
  {
    std::size_t link; ///< index, as in StepView::links
    std::string name;
    bool may_open, rotates;
  };

  /// All links of a scene, those that do not turn first: the same on all ranks, whatever rows a
  /// rank has. And those of a System, whose rows all ranks have.
  std::vector<FixedLink> fixed_links(const Scene &scene, const Constraints &rows);
} // namespace taut

#endif
