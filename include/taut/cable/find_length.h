// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_find_length_h
#define taut_find_length_h

#include <taut/cable/find_shape.h>

#include <functional>

namespace taut
{
  /// Makes the elements of a cable of an unstressed length [m].
  using MakeCable = std::function<CableElements(double length)>;

  /// The unstressed length with which the cable has this horizontal tension [N] or sag [m] between
  /// its ends. Throws UserError if there is none.
  double length_for_tension(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                            const Coordinates &force, double tension);
  double length_for_sag(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                        const Coordinates &force, double sag);

  /// The same with which it passes through a place [m], which is in the plane of its ends and
  /// @p force, between the ends across @p force and below their straight line.
  double length_through(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                        const Coordinates &force, const Coordinates &place);
} // namespace taut

#endif
