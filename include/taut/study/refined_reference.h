// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_refined_reference_h
#define taut_refined_reference_h

#include <taut/study/quantity_recorder.h>

#include <string>
#include <vector>

namespace taut
{
  /// What a quantity is compared with.
  struct QuantityReference
  {
    StudyQuantity quantity;
    double error = 0.; ///< of the reference itself, in the quantity's unit; 0 if it is exact
    double order = 0.; ///< observed under refinement; 0: the changes do not fall like a power
    double scale = 1.; ///< relative errors are relative to it
    bool is_exact = false;
  };

  /**
   * Value and error that the runs of a refinement by halves say, coarsest first.
   *
   * Numbers: Richardson's value with the observed order p, at most 2. Its error is the largest of
   * the correction, the last change and a quarter of the change before it. Where the changes do not
   * fall, the last value and the spread of the last three. Histories are not extrapolated: the
   * last one, with the sum of the geometric series that the changes make, of which the quotient
   * counts as at least 1/4. One level has an infinite error.
   */
  QuantityReference extrapolate(const std::vector<StudyQuantity> &levels);

  /// The exact value or history of an entry Exact, a formula in t, on the times of a run.
  /// Throws UserError if the formula makes no sense.
  StudyQuantity exact_quantity(const std::string &formula, const std::string &entry,
                               const StudyQuantity &quantity);
} // namespace taut

#endif
