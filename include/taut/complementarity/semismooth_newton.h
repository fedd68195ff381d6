// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_semismooth_newton_h
#define taut_semismooth_newton_h

#include <taut/complementarity/active_set_system.h>

#include <array>
#include <cstdint>

namespace taut
{
  /**
   * Semismooth Newton's method for min(w_i N_i, D_i) = 0, which is a primal-dual active set
   * (Hintermueller, Ito, Kunisch 2003): solve on the active set, then let rows with a negative
   * multiplier open and rows with a negative gap close, all at once. Usually one iteration from the
   * set of the last step; but it may cycle, even with a positive definite F, and then says so.
   */
  class SemismoothNewton
  {
  public:
    enum class Outcome
    {
      solved,
      cycle,          ///< an earlier active set came back
      max_iterations, ///< options.max_iterations reached
      unsettled ///< the last active set has dependent rows that contradict each other, or holds a
                ///< body not
    };

    explicit SemismoothNewton(const ComplementarityOptions &options)
        : options(options), system(options)
    {
    }

    /// Starts from solution.closed, and leaves the final set there.
    Outcome solve(const MixedComplementarityProblem &problem, ComplementarityOperator &matrix,
                  MixedComplementaritySolution &solution);

    /// Of the last call.
    unsigned int n_iterations() const { return iterations; }
    const ComplementarityResidual &residual() const { return final_residual; }

  private:
    void collect_set(const MixedComplementarityProblem &problem,
                     const ComplementarityOperator &matrix, MixedComplementaritySolution &solution);
    bool flip_rows(const MixedComplementarityProblem &problem, double dead_band,
                   MixedComplementaritySolution &solution) const;
    bool comes_back();

    ComplementarityOptions options;
    ActiveSetSystem system;
    unsigned int iterations = 0;
    bool stayed = false; ///< the first active set of the last call was its last
    ComplementarityResidual final_residual;

    /// Rows of the active set, ascending; terms s_i and weights w_i of the problem.
    std::vector<std::size_t> set;
    std::vector<double> terms, weights;

    /// Hashes of the last sets: cycles of up to this length are caught at their first return.
    std::array<std::uint64_t, 32> history = {};
  };
} // namespace taut

#endif
