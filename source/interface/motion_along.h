// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_motion_along_h
#define taut_motion_along_h

#include <taut/interface/geometry.h>

#include <vector>

namespace taut
{
  /// TurningDirection::along(), with the memory of the @p terms of an earlier direction.
  void set_motion_along(const TurningDirection &link, const Coordinates &direction,
                        std::vector<Term> &terms);
} // namespace taut

#endif
