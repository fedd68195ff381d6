// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_conjugate_gradients_h
#define taut_conjugate_gradients_h

#include <taut/interface/constraint_operator.h>

#include <vector>

namespace taut
{
  /**
   * Solves A x = b from x = 0 with preconditioned conjugate gradients of Belos. They end if the
   * recursive residual is below @p tolerance times the norm of b, or after @p bound iterations.
   * They end early with the present x at a direction along which A is not positive. Returns the
   * number of iterations. Each rank solves for itself: vectors over constraints are equal on all.
   */
  int conjugate_gradients(const ConstraintOperator &A, ConstraintOperator &preconditioner,
                          const std::vector<double> &b, double tolerance, int bound,
                          std::vector<double> &x);
} // namespace taut

#endif
