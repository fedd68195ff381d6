// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_default_quantities_h
#define taut_default_quantities_h

#include <taut/output/statistics.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * Entries of section Study with quantities of interest, "Study/Quantities=...", for a scene that
   * names none. @p known are the quantities of any run of the scene, those that are 0 are left out.
   * Sliding contacts have mean and standard deviation, with the largest motion of probes. Without
   * them it is the extremes of probes. Without probes it is the link with the largest force, and
   * its impulse. Throws EntryError on Study/Quantities if nothing is left.
   */
  std::vector<std::string> default_quantities(const std::vector<NamedQuantity> &known);
} // namespace taut

#endif
