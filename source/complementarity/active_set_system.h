// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_active_set_system_h
#define taut_active_set_system_h

#include "complementarity/dense_operator.h"
#include "complementarity/options.h"
#include "complementarity/problem.h"

namespace taut
{
  /**
   * The linear system of one active set a: D_i = 0 on its rows, N_i = 0 on all others,
   *
   *     F_aa N_a + G_a^T alpha = -d_a,    G_a N_a - E alpha = -e.
   *
   * alpha comes from the Schur complement G_a F_aa^-1 G_a^T + E. Corrections with the remaining
   * gaps follow. Dependent rows are solved with F_aa + shift diag(F_aa). The corrections are then
   * those of the proximal point method. They end at the exact solution if it exists, with
   * multipliers split evenly.
   */
  class ActiveSetSystem
  {
  public:
    enum class Outcome
    {
      solved,      ///< the gaps of the active set are at the tolerance
      unsettled,   ///< the gaps are not: the rows contradict each other, or nearly so
      inadmissible ///< no solution was computed: the rows do not hold a body, or have no stiffness
    };

    explicit ActiveSetSystem(const ComplementarityOptions &options) : options(options) {}

    /**
     * Writes multiplier, mode_amplitude and gap of @p solution, and the terms s_i of the gaps. @p
     * set is ordered; keeping the order from call to call lets the operator keep its factor. An
     * iterative operator starts from the multipliers and amplitudes of @p solution, and reaches
     * gaps of @p tolerance times s_i. With a tolerance above options.linear_tolerance there is at
     * most one correction.
     */
    Outcome solve(const MixedComplementarityProblem &problem, ComplementarityOperator &matrix,
                  const std::vector<std::size_t> &set, double tolerance,
                  MixedComplementaritySolution &solution, std::vector<double> &terms);

    /// Whether the last solve() found rows of the set to be dependent, without a null space.
    bool has_dependent_rows() const { return shift != 0.; }

  private:
    void start(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
               const std::vector<std::size_t> &set, MixedComplementaritySolution &solution,
               std::vector<double> &terms) const;
    void ask_for(const std::vector<std::size_t> &set, const std::vector<double> &gap,
                 const std::vector<double> &terms, double done);
    bool correct(const MixedComplementarityProblem &problem, ComplementarityOperator &matrix,
                 const std::vector<std::size_t> &set, MixedComplementaritySolution &solution);
    bool correct_with_null_space(const MixedComplementarityProblem &problem,
                                 ComplementarityOperator &matrix,
                                 const std::vector<std::size_t> &set,
                                 MixedComplementaritySolution &solution);
    void balance(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
                 const std::vector<std::size_t> &set, MixedComplementaritySolution &solution);
    void prepare_null_space(const MixedComplementarityProblem &problem,
                            ComplementarityOperator &matrix, const std::vector<std::size_t> &set);
    bool correct_null_space(const MixedComplementarityProblem &problem,
                            const std::vector<std::size_t> &set,
                            MixedComplementaritySolution &solution);

    ComplementarityOptions options;

    double shift = 0.;
    std::vector<double> rhs, step;

    /// The state before a correction, once the set is solved.
    MixedComplementaritySolution before;
    std::vector<double> terms_before;

    /// F_aa^-1 G_k^T for each null space vector, and G_a F_aa^-1 G_a^T + E, for the current set and
    /// shift if null_space_is_ready.
    bool null_space_is_ready = false;
    std::vector<std::vector<double>> null_space_responses;
    DenseOperator null_space_schur;
    std::vector<std::size_t> all_vectors; ///< 0, 1, ... of the null space
    std::vector<double> null_space_rhs, unbalance, amplitude;
  };
} // namespace taut

#endif
