// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_entries_h
#define taut_entries_h

#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace taut
{
  /// Positions from "0, 1.5, 3" or from ranges first:step:last, "0:0.5:10, 12". @p entry is named
  /// in errors.
  std::vector<double> parse_positions(const std::string &text, const std::string &entry);

  /// A stiffness: a positive number, or "rigid" for infinity.
  double parse_stiffness(const std::string &text, const std::string &entry);

  /// A direction "x, y" of any length as a unit vector.
  Point parse_direction(const std::vector<double> &components, const std::string &entry);

  /// The named element of a list of wires or masses; its index, or `ground` if there is none.
  template <typename Item>
  std::size_t find_name(const std::vector<Item> &items, const std::string &name)
  {
    for (std::size_t i = 0; i < items.size(); ++i)
      if (items[i].name == name)
        return i;
    return ground;
  }

  /**
   * Attachments from "ground", "mass", "wire @ 12.5", or several on one wire, "wire @ 0:5:60".
   * Unknown names are UserErrors that list the known ones.
   */
  std::vector<Attachment> parse_attachments(const std::string &text, const Scene &scene,
                                            const std::string &entry);

  /// Place of an attachment in the undeformed scene; not for the ground.
  Point place(const Scene &scene, const Attachment &point);
} // namespace taut

#endif
