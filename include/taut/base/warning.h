// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_warning_h
#define taut_warning_h

#include <string>

namespace taut
{
  /// A warning of a run: a value beyond the limits of the model, the contacts or the steps.
  struct Warning
  {
    std::string kind; ///< an identifier: "slope", "distance", "speed", "filter", "turn" ...
    std::string message;
    double value = 0., limit = 0.; ///< both in `unit`
    std::string unit;
    double time = 0.; ///< of the value [s]
  };
} // namespace taut

#endif
