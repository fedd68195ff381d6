// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_least_number_h
#define taut_least_number_h

#include <limits>

namespace taut
{
  /// Parts of this number by the rounding of sums are normal numbers: what is less may be all that
  /// is left of motions that die out, and is none.
  constexpr double least_number =
      std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
} // namespace taut

#endif
