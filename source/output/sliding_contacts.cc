// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/sliding_contacts.h>

#include <algorithm>

namespace taut
{
  std::vector<SlidingContact> sliding_contacts(const Scene &scene, const Constraints &rows)
  {
    std::vector<SlidingContact> contacts;
    for (const std::size_t i : rows.sliding_rows())
    {
      if (!rows[i].is_link())
        continue;
      const std::size_t link = rows[i].link;
      const std::string strip = link < scene.links.size() ? scene.links[link].strip : "";
      const auto known =
          std::find_if(contacts.begin(), contacts.end(),
                       [&](const SlidingContact &c) { return c.is_strip && c.name == strip; });
      if (!strip.empty() && known != contacts.end())
      {
        known->links.push_back(link);
        known->names.push_back(rows[i].name);
        continue;
      }
      contacts.push_back(
          {strip.empty() ? rows[i].name : strip, {link}, {rows[i].name}, !strip.empty()});
    }
    return contacts;
  }
} // namespace taut
