// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_history_h
#define taut_hunt_history_h

#include "common.h"

namespace hunt
{
  /// What is compared of a motion at one time.
  struct Sample
  {
    double time = 0.;            ///< [s]
    std::vector<double> place;   ///< displacements of all nodes and masses [m]
    std::vector<double> impulse; ///< of each constraint since the start [N s]
    double kinetic = 0.;         ///< [J]
    double potential = 0.;       ///< of bodies, links and constant loads [J]

    double energy() const { return kinetic + potential; }
  };

  using History = std::vector<Sample>; ///< times increase
} // namespace hunt

#endif
