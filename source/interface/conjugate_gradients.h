// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_conjugate_gradients_h
#define taut_conjugate_gradients_h

#include <taut/interface/constraint_operator.h>

#include <vector>

namespace taut
{
  /**
   * Preconditioned conjugate gradients of Belos for A x = b from x = 0, until the norm of the
   * residual that the recursion carries is below @p tolerance times that of b, or @p bound
   * iterations. Ends early, with what it has, at a direction along which A is not positive. Returns
   * the number of iterations. Each rank solves for itself: vectors over constraints are the same on
   * all.
   */
  int conjugate_gradients(const ConstraintOperator &A, ConstraintOperator &preconditioner,
                          const std::vector<double> &b, double tolerance, int bound,
                          std::vector<double> &x);
} // namespace taut

#endif
