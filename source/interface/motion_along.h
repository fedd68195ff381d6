// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_motion_along_h
#define taut_motion_along_h

#include <taut/interface/geometry.h>

#include <vector>

namespace taut
{
  /// B_i of a constraint along directions of its segments, with the memory of the @p terms of
  /// earlier directions.
  void set_motion_along(const TurningDirection &link, const Coordinates *directions,
                        std::vector<Term> &terms);
} // namespace taut

#endif
