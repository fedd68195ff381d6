// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_model_warning_h
#define taut_model_warning_h

#include <string>

namespace taut
{
  /// Something that a run went beyond and the model does not hold for.
  struct ModelWarning
  {
    std::string kind; ///< an identifier: "slope", "distance", "speed", "filter", "turn" ...
    std::string message;
    double value = 0., limit = 0.; ///< both in `unit`
    std::string unit;
    double time = 0.; ///< of the value [s]
  };
} // namespace taut

#endif
