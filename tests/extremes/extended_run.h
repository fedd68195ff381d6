// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_extended_run_h
#define taut_extremes_extended_run_h

#include "observation.h"

namespace extremes
{
  class ExtendedModel;

  /// The answer of a small case in extended precision: total displacements (no increments), dense
  /// factors, the active set by Murty's principal pivoting, which ends for every definite matrix.
  ///
  /// It is made definite by springs of 1e-45 of a body's stiffness in statics, and by a compliance
  /// of 1e-30 of a constraint's flexibility in all constraints. Both change an answer by less than
  /// 1e-25; where they carry loads or gaps, the error says "not held" or "contradictory".
  ///
  /// With @p as_double, the diagonals of M, C, K and F and the multipliers of each step are larger
  /// by one unit in the last place of a double, more or less, and elastic forces at the ends of
  /// steps by one of their terms: what double precision does to a scene.
  Answer extended_answer(const Case &c, bool as_double = false);

  /// The same of another model, whose constraints are the links of the case, observed at @p points.
  Answer extended_answer(const Case &c, const ExtendedModel &model,
                         const std::vector<ObservedPoint> &points, bool as_double = false);
} // namespace extremes

#endif
