// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_certificate_h
#define taut_certificate_h

#include <cstddef>

namespace taut
{
  /**
   * How well an accepted step satisfies its own equations. Recomputed from M, C, K, the states and
   * the definition of the step; the factors of A are not used. All numbers are relative: rounding
   * level is 1e-16 to 1e-11, 1 is wrong.
   */
  struct Certificate
  {
    /// Largest residual of a constraint: |min(F_ii N_i, D_i)|, or |D_i| if bilateral, over the
    /// terms of its gap.
    double complementarity = 0.;
    std::size_t worst_constraint = 0;

    /// Largest residual of the equation of motion of a body, over |P| + max_i |B_i N_i| + |K U_ref|
    /// + |K||U| + |C||V| + |M||dU|/step^2; with mean forces |K||dU| besides.
    double balance = 0.;
    std::size_t worst_body = 0; ///< of this rank

    /// Largest gap of a bilateral rigid constraint that the scheme holds at velocity level only, so
    /// that its position is free to drift [m, rad].
    double drift = 0.;

    /// Kinetic energy of all bodies at the end of the step, of schemes with mean forces and
    /// conditions on gaps only [J].
    double kinetic_energy = 0.;

    /// Energy that the system gained in such a step and that neither loads nor moving constraints
    /// gave [J].
    double energy_gain = 0.;

    unsigned int iterations = 0; ///< of the complementarity solver
    bool fallback = false;       ///< the method that was not chosen finished the step

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &complementarity &worst_constraint &balance &worst_body &drift;
      archive &kinetic_energy &energy_gain &iterations &fallback;
    }

    /// The larger of both; not-a-number if one is.
    double max() const
    {
      return complementarity > balance || complementarity != complementarity ? complementarity
                                                                             : balance;
    }
  };
} // namespace taut

#endif
