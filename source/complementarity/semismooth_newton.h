// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_semismooth_newton_h
#define taut_semismooth_newton_h

#include "complementarity/active_set_system.h"

#include <array>
#include <cstdint>

namespace taut
{
  /**
   * Semismooth Newton's method for min(w_i N_i, D_i) = 0, the primal-dual active-set method
   * (Hintermueller, Ito, Kunisch 2003). Each iteration solves on the active set. Then rows with a
   * negative multiplier open and rows with a negative gap close, all at once. From the set of the
   * last step one iteration is usually enough. The method may cycle, even with a positive definite
   * F; it then returns Outcome::cycle.
   */
  class SemismoothNewton
  {
  public:
    enum class Outcome
    {
      solved,
      cycle,          ///< an earlier active set came back
      max_iterations, ///< options.max_iterations reached
      unsettled ///< dependent rows of the last active set contradict each other, or the set does
                ///< not hold a body
    };

    explicit SemismoothNewton(const ComplementarityOptions &options)
        : options(options), system(options)
    {
    }

    /// Starts from the active set solution.closed, and stores the final set there.
    Outcome solve(const MixedComplementarityProblem &problem, ComplementarityOperator &matrix,
                  MixedComplementaritySolution &solution);

    /// Iterations and residual of the last call.
    unsigned int n_iterations() const { return iterations; }
    const ComplementarityResidual &residual() const { return final_residual; }

    /// Whether rows of the last active set may be dependent.
    bool has_dependent_rows() const { return system.has_dependent_rows(); }

  private:
    void collect_set(const MixedComplementarityProblem &problem,
                     const ComplementarityOperator &matrix, MixedComplementaritySolution &solution);
    bool flip_rows(const MixedComplementarityProblem &problem, double dead_band,
                   MixedComplementaritySolution &solution) const;
    bool comes_back(const SharedRows *rows);

    ComplementarityOptions options;
    ActiveSetSystem system;
    unsigned int iterations = 0;
    bool stayed = false; ///< the first active set of the last call was its last set
    ComplementarityResidual final_residual;

    /// Rows of the active set, ascending; terms s_i and weights w_i of the problem.
    std::vector<std::size_t> set;
    std::vector<double> terms, weights;

    /// Hashes of the last sets: cycles of up to this length are caught at their first return.
    std::array<std::uint64_t, 32> history = {};
    std::uint64_t current = 0; ///< hash of the present set
  };
} // namespace taut

#endif
