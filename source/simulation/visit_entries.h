// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_visit_entries_h
#define taut_visit_entries_h

#include <nlohmann/json.hpp>

#include <string>

namespace taut
{
  /// Calls @p see with path and node of each entry in a listing of listing_of(), or below @p
  /// section of it.
  template <typename See>
  void visit_entries(const nlohmann::json &listing, const See &see, const std::string &section = "")
  {
    for (const auto &[name, child] : listing.items())
      if (!child.is_object())
        continue;
      else if (child.contains("pattern_description"))
        see(section + name, child);
      else
        visit_entries(child, see, section + name + "/");
  }
} // namespace taut

#endif
