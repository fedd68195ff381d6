// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sliding_contacts_h
#define taut_sliding_contacts_h

#include <taut/interface/constraints.h>
#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace taut
{
  /// A sliding contact as results name it: a link, or all links of one strip, whose force is the
  /// sum over its wires.
  struct SlidingContact
  {
    std::string name;               ///< of the link or the strip
    std::vector<std::size_t> links; ///< of the scene; the first one gives the position
    std::vector<std::string> names; ///< of the links
    bool is_strip = false;
  };

  /// The sliding contacts in the order of @p rows. Rows of a program without a scene are single
  /// contacts.
  std::vector<SlidingContact> sliding_contacts(const Scene &scene, const Constraints &rows);
} // namespace taut

#endif
