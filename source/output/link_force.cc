// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/link_force.h>
#include <taut/output/rainflow.h>

#include <algorithm>

namespace taut
{
  void LinkForce::start(const double force)
  {
    least = largest = mean = last = force;
    if (keeps_reversals)
      reversals = {force};
  }

  void LinkForce::add(const double force, const double dt)
  {
    least = std::min(least, force);
    largest = std::max(largest, force);
    n_slackenings += last != 0. && force == 0.;
    last = force;
    if (keeps_reversals)
      add_reversal(reversals, force);
    // Welford's recurrence, with steps as weights.
    time += dt;
    const double distance = force - mean;
    mean += dt / time * distance;
    squares += dt * distance * (force - mean);
  }
} // namespace taut
