// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solver_h
#define taut_solver_h

#include <taut/complementarity/energy_ordered.h>
#include <taut/complementarity/semismooth_newton.h>

#include <string>

namespace taut
{
  /// A solved problem and how it was solved.
  struct ComplementarityResult
  {
    MixedComplementaritySolution solution;

    /// Active sets that Newton's method solved for, and changes of one row each by the
    /// energy-ordered set: of all attempts.
    unsigned int iterations = 0;

    /// The method that was not chosen got to the end.
    bool used_fallback = false;

    /// At most the tolerance.
    ComplementarityResidual residual;
  };

  /**
   * Solves one mixed complementarity problem after another, each starting from the active set of
   * the one before. A problem with bilateral rows only takes one linear solve, and one from a set
   * that is still right just as well.
   */
  class ComplementaritySolver
  {
  public:
    /**
     * @p method is "semismooth Newton", with the energy-ordered active set taking over whenever it
     * does not get to the end, or "energy-ordered" to begin with this one. Where this one misses
     * the tolerance, Newton's method tries from the set that it found. Another name is a UserError.
     */
    explicit ComplementaritySolver(
        const std::string &method = "semismooth Newton",
        const ComplementarityOptions &options = ComplementarityOptions());

    /**
     * The result stays valid, and is the start, until the next call; a problem of another size
     * starts anew. Throws ContradictoryRows, BodyNotHeld with the indices of its rows and null
     * space vectors, and NotSolved if the residual ends above the tolerance. After an exception the
     * next call starts anew.
     */
    const ComplementarityResult &solve(const MixedComplementarityProblem &problem,
                                       ComplementarityOperator &matrix);

    /// Starts the next problem from these closed rows, e.g. those of a checkpoint. Empty: from
    /// none.
    void start_from(const std::vector<char> &closed) { result.solution.closed = closed; }

  private:
    void check_inert_rows(const MixedComplementarityProblem &problem,
                          const ComplementarityOperator &matrix) const;
    bool solve_with_newton(const MixedComplementarityProblem &problem,
                           ComplementarityOperator &matrix);
    void solve_energy_ordered(const MixedComplementarityProblem &problem,
                              ComplementarityOperator &matrix);

    ComplementarityOptions options;
    bool use_newton;
    SemismoothNewton newton;
    EnergyOrderedActiveSet energy_ordered;
    ComplementarityResult result;
  };
} // namespace taut

#endif
