// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_extended_complementarity_h
#define taut_extremes_extended_complementarity_h

#include "extended_model.h"

namespace extremes
{
  /// x with y = F x + d, 0 <= x _|_ y >= 0 in unilateral rows and y = 0 in the others, by Murty's
  /// least-index principal pivoting from a set of rows that are guessed closed. F is definite.
  Vector principal_pivoting(const Matrix &F, const Vector &d, const std::vector<char> &unilateral,
                            std::vector<char> closed);

  /// Of the units in the last place of a double that number i is changed by: 1, 0.5 or 1.5.
  Number last_place(std::size_t i);
} // namespace extremes

#endif
