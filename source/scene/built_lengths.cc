// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/built_lengths.h"

#include "base/text.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  void take_lengths(const CsvTable &built, const std::string &entry, const std::string &name,
                    const std::string &wire, const double begin, const double end,
                    const double origin, std::vector<LineDropper *> droppers)
  {
    constexpr double same_place = 1e-3;                // of a clamp [m]
    std::vector<std::pair<double, std::size_t>> known; ///< x and row
    for (std::size_t row = 0; row < built.n_rows(); ++row)
      if (built.text(row, "lower wire") == wire && built.text(row, "dropper").find(name) == 0)
        if (const double x = built.number(row, "x [m]"); x > begin && x < end)
          known.emplace_back(x, row);
    std::sort(known.begin(), known.end());
    std::sort(droppers.begin(), droppers.end(),
              [](const LineDropper *a, const LineDropper *b) { return a->x < b->x; });
    for (std::size_t i = 0; i < droppers.size(); ++i)
    {
      const double x = origin + droppers[i]->x;
      const auto found = known.size() == droppers.size()
                             ? known.begin() + i
                             : std::find_if(known.begin(), known.end(),
                                            [x](const std::pair<double, std::size_t> &at)
                                            { return std::fabs(at.first - x) < same_place; });
      if (found == known.end())
        throw EntryError(entry,
                         to_text("droppers.csv there has ", known.size(), " droppers on wire '",
                                 wire, "' from ", begin, " to ", end, " m, none of them at ", x,
                                 " m, where one of ", droppers.size(),
                                 " hangs. Give as many, or those at places of the file"));
      droppers[i]->length = built.number(found->second, "cut length [m]");
      droppers[i]->built = built.number(found->second, "length as built [m]");
      if (!(droppers[i]->length > 0. && droppers[i]->built > 0.))
        built.fail(found->second, "a dropper has a positive length");
    }
  }
} // namespace taut
