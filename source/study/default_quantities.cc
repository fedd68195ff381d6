// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/default_quantities.h"
#include <taut/base/exceptions.h>
#include <taut/output/table_file.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace taut
{
  namespace
  {
    using Named = NamedQuantity;

    std::vector<Named> quantities_of_kind(const std::vector<Named> &known,
                                          const std::vector<std::string> &kinds)
    {
      std::vector<Named> list;
      for (const Named &q : known)
        if (std::isfinite(q.value) && q.value != 0. &&
            std::count(kinds.begin(), kinds.end(), q.quantity) > 0)
          list.push_back(q);
      return list;
    }

    std::vector<Named> strongest_link(const std::vector<Named> &known)
    {
      std::vector<Named> list = quantities_of_kind(known, {"largest force", "impulse"});
      const Named *strongest = nullptr;
      for (const Named &q : list)
        if (q.quantity == "largest force" && (!strongest || q.value > strongest->value))
          strongest = &q;
      const std::string item = strongest ? strongest->item : "";
      list.erase(
          std::remove_if(list.begin(), list.end(), [&](const Named &q) { return q.item != item; }),
          list.end());
      return list;
    }
  } // namespace

  std::vector<std::string> default_quantities(const std::vector<Named> &known)
  {
    std::vector<Named> chosen = quantities_of_kind(known, {"mean", "standard deviation"});
    chosen = chosen.empty() ? quantities_of_kind(known, {"largest", "smallest"})
                            : quantities_of_kind(known, {"mean", "standard deviation", "largest"});
    if (chosen.empty())
      chosen = strongest_link(known);
    if (chosen.empty())
      throw EntryError("Study/Quantities", "the scene has no probe and no force of a link by "
                                           "itself; name quantities of interest");
    std::map<std::string, double> extreme; // of each probe: one scale for both its extremes
    for (const Named &q : chosen)
      extreme[q.item] = std::max(extreme[q.item], std::fabs(q.value));
    std::string names;
    std::vector<std::string> entries(1);
    for (const Named &q : chosen)
    {
      const std::string name = q.item + " " + q.quantity, section = "Study/Quantity " + name;
      names += (names.empty() ? "" : ", ") + name;
      entries.push_back(section + "/Of=" + q.item);
      entries.push_back(section + "/Quantity=" + q.quantity);
      if (q.quantity == "largest" || q.quantity == "smallest")
        entries.push_back(section + "/Scale=" + csv_number(extreme[q.item]));
    }
    entries[0] = "Study/Quantities=" + names;
    return entries;
  }
} // namespace taut
