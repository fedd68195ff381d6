// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_built_lengths_h
#define taut_built_lengths_h

#include "scene/line_geometry.h"

#include "base/csv_table.h"

namespace taut
{
  /**
   * Gives the droppers of one span of a wire, from x = @p begin to @p end [m] in the scene, their
   * lengths in the table of droppers of an earlier run, @p built. As many as there were take them
   * from the first to the last, so that some may hang elsewhere than before. Of more or fewer each
   * takes that of the one at its place. @p name begins the names of the droppers, and @p origin is
   * x of the begin of the line [m]. Throws EntryError on @p entry.
   */
  void take_lengths(const CsvTable &built, const std::string &entry, const std::string &name,
                    const std::string &wire, double begin, double end, double origin,
                    std::vector<LineDropper *> droppers);
} // namespace taut

#endif
