// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/newton_search.h"

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Part of the expected decrease of the energy that a step has to make.
    constexpr double sufficient = 1e-4;

    /// Rounding of the energy of stiff and thin bodies, whose strains are small differences of
    /// large positions.
    constexpr double rounding = 1e-9;

    /// Part of a full step at which twenty halvings end.
    constexpr double shortest_step = 1e-6;

    void shorten(DescentProblem &problem)
    {
      const DescentProblem::Descent start = problem.descent();
      const double slope = std::min(0., start.slope);
      const bool is_flat = -slope <= rounding * std::fabs(start.energy);
      for (double s = 1.; s > shortest_step; s *= .5)
      {
        const double energy = problem.shorten_to(s);
        if (energy <= start.energy + sufficient * s * slope +
                          (is_flat && s == 1. ? rounding * std::fabs(start.energy) : 0.))
          return;
      }
    }
  } // namespace

  bool NewtonSearch::find(NewtonProblem &problem) const
  {
    return iterate(problem, nullptr, most_full);
  }

  bool NewtonSearch::descend(DescentProblem &problem) const
  {
    return iterate(problem, &problem, most_damped);
  }

  bool NewtonSearch::iterate(NewtonProblem &problem, DescentProblem *const damped,
                             const int most) const
  {
    NewtonConvergence convergence(limits);
    problem.begin();
    for (int iteration = 0; iteration < most; ++iteration)
    {
      const NewtonConvergence::Verdict verdict = convergence.add(problem.solve());
      if (verdict == NewtonConvergence::Verdict::converged)
        return problem.accept();
      if (verdict == NewtonConvergence::Verdict::failed)
        return false;
      if (damped)
        shorten(*damped);
      problem.go_on();
    }
    return false;
  }
} // namespace taut
