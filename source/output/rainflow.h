// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rainflow_h
#define taut_rainflow_h

#include <vector>

namespace taut
{
  /// Cycles of one range between reversals of a record.
  struct LoadCycle
  {
    double range; ///< largest minus smallest value, in the unit of the record
    double mean;
    double count; ///< 1, or 1/2 for one of the reversals that are left over
  };

  /// Adds a value of a record to its reversals so far.
  void add_reversal(std::vector<double> &reversals, double value);

  /// The reversals of a record: its first and last value, and the extremes in between.
  std::vector<double> reversals(const std::vector<double> &record);

  /// Cycles of a record by rainflow counting, as in ASTM E1049, in the order in which they close.
  std::vector<LoadCycle> rainflow(const std::vector<double> &record);
} // namespace taut

#endif
