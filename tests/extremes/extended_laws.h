// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_extended_laws_h
#define taut_extremes_extended_laws_h

#include "extended_model.h"

namespace extremes
{
  /// The mean force of an elastic contact that keeps the energy W = stiffness max(0, u)^2 / 2 over
  /// a step from compression u_0, negative where it was open: N = 2 (W(u) - W(u_0)) / (u - u_0) as
  /// the multiplier of the end of a step of theta = 1/2. It increases and is convex.
  class ConservingLaw
  {
  public:
    ConservingLaw(const Number &stiffness, const Number &before)
        : stiffness(stiffness), before(before)
    {
    }

    Number force(const Number &u) const;
    Number slope(const Number &u) const;

    /// Where a contact without force counts as: nothing pushes below.
    Number least_compression(const Number &u) const;

  private:
    Number stiffness, before;
  };

  /// N >= 0 of D = F N + d where constraint k has N_k = law(-D_k) if it has a law, and
  /// 0 <= N_k _|_ D_k >= 0 or D_k = 0 else, as of principal_pivoting(). Newton's method, with the
  /// energy made least along the way of a step that may have increased it.
  Vector solve_with_laws(const Matrix &F, const Vector &d, const std::vector<char> &unilateral,
                         std::vector<char> closed,
                         const std::vector<std::optional<ConservingLaw>> &laws);
} // namespace extremes

#endif
