// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_refined_reference_h
#define taut_refined_reference_h

#include "study/quantity_recorder.h"

#include <string>
#include <vector>

namespace taut
{
  /// The reference of a quantity of a study.
  struct QuantityReference
  {
    StudyQuantity quantity;
    double error = 0.; ///< of the reference, in the unit of the quantity; 0: exact
    double order = 0.; ///< observed under refinement; 0: the changes do not fall like a power
    double scale = 1.; ///< errors are relative to this scale
    bool is_exact = false;
  };

  /**
   * Value and error from runs of a refinement by halves, coarsest run first.
   *
   * Numbers have Richardson's value with the observed order p, at most 2. The error is the largest
   * of the correction, the last change and a quarter of the change before the last. If the changes
   * do not fall, the value is the last value, with the spread of the last three values as error.
   * Histories are not extrapolated. The reference is the last history, and its error the sum of the
   * geometric series of the changes, with a quotient of at least 1/4. One level has an infinite
   * error.
   */
  QuantityReference extrapolate(const std::vector<StudyQuantity> &levels);

  /// The exact value or history of an entry Exact, a formula in t, on the times of a run.
  /// Throws UserError if the formula makes no sense.
  StudyQuantity exact_quantity(const std::string &formula, const std::string &entry,
                               const StudyQuantity &quantity);
} // namespace taut

#endif
