// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_newton_search_h
#define taut_newton_search_h

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
      /// did not halve the least change so far: rounding sustains them.
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
      n_in_vain = change <= .5 * least ? 0 : n_in_vain + 1;
      least = n_in_vain == 0 ? change : least;
      if (change <= limits.converged ||
          (change <= limits.stagnated && n_in_vain >= limits.most_stagnant))
        return Verdict::converged;
      return !std::isfinite(change) || n_in_vain == limits.most_in_vain ? Verdict::failed
                                                                        : Verdict::goes_on;
    }

  private:
    const Limits limits;
    double least = std::numeric_limits<double>::infinity();
    int n_in_vain = 0;
  };

  /// Equations for Newton's method: a step in time of bodies that are not linear, for example.
  class NewtonProblem
  {
  public:
    virtual ~NewtonProblem() = default;

    /// Makes the start the guess.
    virtual void begin() = 0;

    /// Solves the equations, linearised at the guess. Returns the relative error of what accept()
    /// would take; not-a-number if there is no solution.
    virtual double solve() = 0;

    /// Makes the solution the guess.
    virtual void go_on() = 0;

    /// Ends the iterations, which have converged. False if this is no solution that counts, such as
    /// an equilibrium that is not stable.
    virtual bool accept() = 0;
  };

  /// The same where a solution has the least energy of its surroundings.
  class DescentProblem : public NewtonProblem
  {
  public:
    /// Energy at a guess, and its derivative on the way to the solution, which ends at 1 [J].
    struct Descent
    {
      double energy, slope;
    };

    /// After solve().
    virtual Descent descent() = 0;

    /// Makes the place @p s on the way from the guess to the solution of solve() the solution, and
    /// returns the energy there [J].
    virtual double shorten_to(double s) = 0;
  };

  /// Newton's method, with full steps or with a line search on the energy. The step in time, the
  /// equilibrium of a structure and that of a cable are found with it.
  class NewtonSearch
  {
  public:
    /// Most iterations with full steps, and with a line search.
    NewtonSearch(const NewtonConvergence::Limits &limits, const int most_full,
                 const int most_damped = 0)
        : limits(limits), most_full(most_full), most_damped(most_damped)
    {
    }

    /// With full steps. False if this finds no solution.
    bool find(NewtonProblem &problem) const;

    /// With steps that are shortened until the energy falls enough (L. Armijo, Pacific J. Math. 16
    /// (1966)).
    bool descend(DescentProblem &problem) const;

    /// With full steps, and if these end nowhere, with shortened ones.
    bool find_or_descend(DescentProblem &problem) const
    {
      return find(problem) || descend(problem);
    }

  private:
    bool iterate(NewtonProblem &problem, DescentProblem *damped, int most) const;

    NewtonConvergence::Limits limits;
    int most_full, most_damped;
  };
} // namespace taut

#endif
