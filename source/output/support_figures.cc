// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/reactions.h"
#include "output/signals.h"
#include <taut/output/support_figures.h>

#include <algorithm>

namespace taut
{
  SupportFigures::SupportFigures(const Scene &scene)
  {
    for (const SupportPoint &point : support_points(scene))
      figures.push_back({point.name, scene.wires[scene.supports[point.support].wire].name,
                         point.position, point.is_moment ? "N m" : "N"});
  }

  void SupportFigures::record(const std::vector<double> &reactions, const double dt,
                              const bool in_window)
  {
    for (std::size_t i = 0; i < figures.size(); ++i)
    {
      Figures &f = figures[i];
      if (dt == 0.)
        f.at_start = reactions[i];
      if (!in_window)
        continue;
      if (f.n_samples++ == 0)
        f.window.start(reactions[i]);
      if (dt > 0.)
        f.window.add(reactions[i], dt);
    }
  }

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
