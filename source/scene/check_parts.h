// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_check_parts_h
#define taut_check_parts_h

#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/scene/scene.h>

#include <string>

namespace taut
{
  /// Throws an EntryError about an entry of an item; the path is empty for an item without a
  /// parameter file.
  template <typename Item, typename... Parts>
  void fail(const Item &item, const std::string &entry, const Parts &...parts)
  {
    // The message must show that a position is outside, even by little.
    throw EntryError(item.origin.empty() || entry.empty() ? item.origin : item.origin + "/" + entry,
                     to_text(std::setprecision(12), parts...));
  }

  /// Whether a point has a motion along a direction, or a rotation about it.
  bool can_move(const Scene &scene, const Attachment &end, bool rotational,
                const Coordinates &direction);

  /// Throws an EntryError if a sliding contact has no wire to slide on, or leaves it before @p
  /// end_time [s]. @p what begins the message.
  void check_sliding(const Scene &scene, const Link &link, const std::string &what,
                     double end_time);

  /// Throws an EntryError unless each strip has a wire over it until @p end_time [s].
  void check_strips(const Scene &scene, double end_time);

  /// Throws an EntryError for items of one kind with one name, or with names that tables cannot
  /// tell apart.
  void check_names(const Scene &scene);
} // namespace taut

#endif
