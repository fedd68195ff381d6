// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_problem_h
#define taut_problem_h

#include "complementarity/operator.h"
#include "complementarity/shared_rows.h"
#include <taut/complementarity/cone.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /**
   * The mixed linear complementarity problem (LCP) of one step, without its matrix F
   * (ComplementarityOperator):
   *
   *     D = F N + d + G^T alpha,    G N - E alpha = -e,
   *     D_i = 0                             on bilateral rows, whose cone is free,
   *     N_i >= 0, D_i >= 0, N_i D_i = 0     on unilateral rows, whose cone is a half line.
   *
   * The multipliers N are contact forces, the Lagrange multipliers of the constraints; the rows are
   * constraints. Translations have N in N and D in m, rotations N in N m and D in rad. A row with
   * F_ii = 0 that no null space vector moves is inert: its gap is d_i whatever the multipliers, and
   * its multiplier is 0.
   */
  struct MixedComplementarityProblem
  {
    /// Size n: the cone of the multipliers that each row admits.
    std::vector<Cone> cones;

    /// d, size n: the gaps without multipliers [m, rad].
    std::vector<double> free_gap;

    /**
     * Size n, or empty: magnitude of the terms that d_i was summed from, if these are much larger
     * than d_i [m, rad]. Rounding of d_i is measured against |d_i| + gap_scale_i.
     */
    std::vector<double> gap_scale;

    /// G, n_null_space() vectors over the rows: the motions of the rows with the null space vectors
    /// (rigid body modes) of floating bodies. Empty without floating bodies.
    std::vector<LinearForm> null_space;

    /// e, n_null_space(): load on each null space vector, which G N has to balance [N, N m].
    std::vector<double> null_space_load;

    /// n_null_space(), or empty: magnitude of the terms that e was summed from, to which its
    /// rounding is relative [N, N m].
    std::vector<double> null_space_terms;

    /// Diagonal of E, n_null_space() or empty for zeros: the resistance to each null space vector,
    /// the inertia of the body in a step [N/m, N m/rad].
    std::vector<double> null_space_resistance;

    double resistance(std::size_t k) const
    {
      return null_space_resistance.empty() ? 0. : null_space_resistance[k];
    }

    /// True if a null space vector has a resistance.
    bool has_resistance() const;

    /// Null: all ranks have all rows. Otherwise the vectors here have the rows of this rank, those
    /// over null space vectors are the same on all ranks, and all functions are called by all ranks
    /// together.
    const SharedRows *shared = nullptr;

    /// The largest value that any rank found on its rows; not-a-number if one is.
    double max(const double value) const { return shared ? shared->max(value) : value; }
    bool any(const bool is_true) const { return max(is_true ? 1. : 0.) > 0.; }

    /// G N, and the sums of its absolute terms.
    void forces_on_null_space(const std::vector<double> &multiplier,
                              std::vector<double> &result) const;
    void sizes_on_null_space(const std::vector<double> &multiplier,
                             std::vector<double> &result) const;

    std::size_t size() const { return cones.size(); }
    std::size_t n_null_space() const { return null_space_load.size(); }

    /// Not 0 for rows that a null space vector moves. Empty without null space vectors.
    std::vector<char> rows_in_null_space() const;

    /// Throws std::invalid_argument if the sizes of the arrays and of the operator do not fit
    /// together.
    void check(const ComplementarityOperator &matrix) const;
  };

  /// The solution of a solver, and its start.
  struct MixedComplementaritySolution
  {
    std::vector<double> multiplier;     ///< N [N, N m]
    std::vector<double> gap;            ///< D [m, rad]
    std::vector<double> mode_amplitude; ///< alpha, n_null_space()

    /// Size n, the active set: not 0 where N_i was solved for and D_i = 0; 0 where N_i = 0.
    std::vector<char> closed;

    /// Zero multipliers and amplitudes; d as gaps. Keeps @p closed if it has the right size, else
    /// opens all rows.
    void reset(const MixedComplementarityProblem &problem);
  };

  /**
   * The size s_i of the terms that the gap of a row is summed from, to which the rounding error of
   * the gap is relative:
   *
   *     s_i = t_i + sum_k |G_ki| max(|alpha_k|, a_k),    t_i = |d_i| + gap_scale_i + sum_j |F_ij|
   * |N_j|.
   *
   * alpha_k follows from the gaps of closed rows, mainly of stiff rows, and rounds with these gaps
   * even if it ends near zero: a_k = sum_i |G_ki| t_i / F_ii over sum_i G_ki^2 / F_ii fits their
   * terms.
   */
  void gap_terms(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
                 const std::vector<double> &multiplier, const std::vector<double> &mode_amplitude,
                 std::vector<double> &terms);

  /**
   * D = F N + d + G^T alpha.
   */
  void gaps(const MixedComplementarityProblem &problem, const ComplementarityOperator &matrix,
            const std::vector<double> &multiplier, const std::vector<double> &mode_amplitude,
            std::vector<double> &gap);

  /**
   * The positive factor w_i that makes a multiplier comparable with a gap in min(w_i N_i, D_i):
   * F_ii. The diagonal of F of a floating body depends on the choice of a pseudo-inverse and may
   * vanish. Rows that a null space vector moves therefore have max(F_ii, s_i / max_j |N_j|). Where
   * loads cancel, so that no N_j is more than a thousandth of their terms, these take its place.
   */
  void multiplier_weights(const MixedComplementarityProblem &problem,
                          const ComplementarityOperator &matrix,
                          const std::vector<double> &multiplier, const std::vector<double> &terms,
                          std::vector<double> &weights);

  /**
   * How well a problem is solved. All numbers are relative: 1e-10 is solved, 1 is not. A row
   * without terms (s_i = 0) counts as 0 if it holds exactly, and as infinite otherwise;
   * not-a-number remains not-a-number.
   */
  struct ComplementarityResidual
  {
    /// |min(w_i N_i, D_i)| / s_i on unilateral rows, |D_i| / s_i on bilateral rows.
    std::vector<double> rows;

    /// |G N - E alpha + e|_k / (|e_k| + its terms + E_k |alpha_k| + sum_i |G_ki| (|N_i| + s_i /
    /// w_i)): multipliers are known to rounding of s_i / w_i.
    std::vector<double> null_space;

    /// The largest of all entries, of all ranks.
    double max = 0.;

    std::vector<double> sums; ///< work of residual()
  };

  /// The one definition of "solved". @p gap may come from F N + d + G^T alpha or from the
  /// displacements.
  ComplementarityResidual residual(const MixedComplementarityProblem &problem,
                                   const ComplementarityOperator &matrix,
                                   const MixedComplementaritySolution &solution);

  /// Completes a solution with multipliers and amplitudes: its gaps, and as closed the rows with
  /// multipliers and the bilateral ones that something moves.
  ComplementarityResidual close_rows(const MixedComplementarityProblem &problem,
                                     const ComplementarityOperator &matrix,
                                     MixedComplementaritySolution &solution);

  /// As above, from terms and weights of the caller. Allocates nothing if @p result has its size.
  void residual(const MixedComplementarityProblem &problem,
                const MixedComplementaritySolution &solution, const std::vector<double> &terms,
                const std::vector<double> &weights, ComplementarityResidual &result);
} // namespace taut

#endif
