// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solver_h
#define taut_solver_h

#include "complementarity/energy_ordered.h"
#include "complementarity/mprgp.h"
#include "complementarity/repeated_rows.h"
#include "complementarity/semismooth_newton.h"

#include <memory>
#include <string>

namespace taut
{
  /// A solved problem and how it was solved.
  struct ComplementarityResult
  {
    MixedComplementaritySolution solution;

    /// Active sets of Newton's method, changes of one row by the energy-ordered method, and steps
    /// of MPRGP that close or open rows, of all attempts.
    unsigned int iterations = 0;

    /// True if the other method, not the chosen one, found the solution.
    bool used_fallback = false;

    /// The residual, at most the tolerance.
    ComplementarityResidual residual;
  };

  /**
   * Solves a sequence of mixed complementarity problems, one per step of a run. Each starts from
   * the active set of the problem before. By Newton's method a problem with bilateral rows only
   * takes one linear solve, and so does a problem whose active set has not changed. Bilateral rows
   * that repeat others get multipliers of least norm, see RepeatedRows.
   */
  class ComplementaritySolver
  {
  public:
    /**
     * @p method is "semismooth Newton", "energy-ordered" or "MPRGP". Where Newton's method fails on
     * an F without entries, MPRGP takes over; its active set is then solved exactly. Where they
     * fail, the energy-ordered method does, which names what has no solution. Where it misses the
     * tolerance, Newton's method starts from its active set. Another name is a UserError.
     */
    explicit ComplementaritySolver(
        const std::string &method = "semismooth Newton",
        const ComplementarityOptions &options = ComplementarityOptions());

    /**
     * The result is valid until the next call, which starts from it; a problem of another size
     * starts anew. Throws ContradictoryRows with indices of rows, BodyNotHeld with indices of null
     * space vectors, and NotSolved if the residual remains above the tolerance. After an exception
     * the next call starts anew.
     */
    const ComplementarityResult &solve(const MixedComplementarityProblem &problem,
                                       ComplementarityOperator &matrix);

    /// Starts the next problem from these closed rows, e.g. those of a checkpoint. Empty: from no
    /// closed row.
    void start_from(const std::vector<char> &closed) { result.solution.closed = closed; }

    // Where rows are shared, what Newton's method does not solve is solved with all rows on all
    // ranks. Indices of rows in exceptions, and repeated rows, are numbers then.

    /// Before the problems of one search whose rows are linearised, from a state that satisfies
    /// them: rows that repeat others there are the same in all of these problems. Gaps of such rows
    /// are then no error, as they have the error of the linearisation.
    void begin_search()
    {
      is_linearised = true;
      has_sought = false;
      if (whole)
        whole->begin_search();
    }

    /// Rows that repeat others, found or of an earlier solver.
    const RepeatedRows &repeated_rows() const { return whole ? whole->repeated : repeated; }
    void set_repeated_rows(const RepeatedRows &rows)
    {
      begin_search();
      repeated = rows;
      has_sought = !rows.empty();
      if (whole)
        whole->set_repeated_rows(rows);
    }

  private:
    void solve_shared(const MixedComplementarityProblem &problem, ComplementarityOperator &matrix);
    void solve_whole(const MixedComplementarityProblem &problem, ComplementarityOperator &matrix);
    void check_inert_rows(const MixedComplementarityProblem &problem,
                          const ComplementarityOperator &matrix) const;
    bool spread_over_repeated_rows(const MixedComplementarityProblem &problem,
                                   const ComplementarityOperator &matrix);
    bool solve_with_newton(const MixedComplementarityProblem &problem,
                           ComplementarityOperator &matrix);
    bool solve_by_products(const MixedComplementarityProblem &problem,
                           ComplementarityOperator &matrix);
    void solve_energy_ordered(const MixedComplementarityProblem &problem,
                              ComplementarityOperator &matrix);

    std::string method;
    ComplementarityOptions options;
    bool use_newton, use_mprgp;
    SemismoothNewton newton;
    EnergyOrderedActiveSet energy_ordered;
    Mprgp mprgp;
    ComplementarityResult result;
    RepeatedRows repeated;
    bool has_sought = false, is_linearised = false;
    std::vector<double> terms;
    std::unique_ptr<ComplementaritySolver> whole; ///< of rows that are shared
  };
} // namespace taut

#endif
