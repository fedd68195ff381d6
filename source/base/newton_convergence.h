// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_newton_convergence_h
#define taut_newton_convergence_h

#include <cmath>
#include <limits>

namespace taut
{
  /// Decides when Newton iterations end, by the relative change of the unknowns in each iteration.
  class NewtonConvergence
  {
  public:
    struct Limits
    {
      double converged; ///< change below which iterations have converged

      /// Changes below `stagnated` also end the iterations after `most_stagnant` iterations that
      /// did not halve the previous change: rounding sustains them.
      double stagnated;
      int most_stagnant;

      /// So many iterations that do not halve the least change so far are a failure.
      int most_in_vain = std::numeric_limits<int>::max();
    };

    explicit NewtonConvergence(const Limits &limits) : limits(limits) {}

    enum class Verdict
    {
      goes_on,
      converged,
      failed
    };

    /// Adds the change of the next iteration.
    Verdict add(const double change)
    {
      n_stagnant = change >= .5 * last ? n_stagnant + 1 : 0;
      last = change;
      if (change <= limits.converged ||
          (change <= limits.stagnated && n_stagnant >= limits.most_stagnant))
        return Verdict::converged;
      n_in_vain = change <= .5 * least ? 0 : n_in_vain + 1;
      least = n_in_vain == 0 ? change : least;
      return !std::isfinite(change) || n_in_vain == limits.most_in_vain ? Verdict::failed
                                                                        : Verdict::goes_on;
    }

  private:
    const Limits limits;
    double last = std::numeric_limits<double>::infinity(), least = last;
    int n_stagnant = 0, n_in_vain = 0;
  };
} // namespace taut

#endif
