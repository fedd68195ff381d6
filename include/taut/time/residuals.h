// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_residuals_h
#define taut_residuals_h

#include <cstddef>

namespace taut
{
  /// The residuals of an accepted step. They are computed from M, C, K, the states and the
  /// definition of the step, without the factors of A. Residuals are relative: rounding is 1e-16 to
  /// 1e-11, and 1 is wrong.
  struct Residuals
  {
    /// Largest residual of a constraint over the terms of its gap: |min(F_ii N_i, D_i)|, or |D_i|
    /// if bilateral.
    double complementarity = 0.;
    std::size_t worst_constraint = 0; ///< its number among all ranks' rows

    /// Largest residual of the equation of motion of a body, over |P| + max_i |B_i N_i| + |K U_ref|
    /// + |K||U| + |C||V| + |M||dU|/step^2, with mean forces plus |K||dU|.
    double balance = 0.;
    std::size_t worst_body = 0; ///< on this rank

    /// Largest gap of a bilateral rigid constraint with conditions on velocities only, whose
    /// position may drift [m, rad].
    double drift = 0.;

    unsigned int iterations = 0; ///< of the complementarity solver
    bool fallback = false;       ///< the solver's other method finished the step

    /// At rest: systems with the contact Schur complement that conjugate gradients have solved, and
    /// their iterations; products with it in all.
    long n_systems = 0, n_inner_iterations = 0, n_products = 0;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &complementarity &worst_constraint &balance &worst_body &drift;
      archive &iterations &fallback;
    }

    /// The larger residual; not-a-number if one is.
    double max() const
    {
      return complementarity > balance || complementarity != complementarity ? complementarity
                                                                             : balance;
    }
  };
} // namespace taut

#endif
