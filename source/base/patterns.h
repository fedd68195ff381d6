// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_patterns_h
#define taut_patterns_h

#include <deal.II/base/patterns.h>

namespace taut
{
  /// Of an entry in a parameter file: a number that is not negative.
  inline dealii::Patterns::Double not_negative()
  {
    return dealii::Patterns::Double(0., dealii::Patterns::Double::max_double_value);
  }
} // namespace taut

#endif
