// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_find_length_h
#define taut_find_length_h

#include <taut/cable/find_shape.h>

#include <functional>

namespace taut
{
  /// Makes the elements of a cable of an unstressed length [m].
  using MakeCable = std::function<CableElements(double length)>;

  /**
   * Form finding: the unstressed length [m] with which the cable has this horizontal tension [N] or
   * sag [m], both positive, between its ends [m] under a force per unstressed length [N/m], weight
   * and wind. horizontal_tension() and sag() define the two quantities. A parabola is the first
   * guess, then a root is bracketed (TOMS 748). Throws UserError if no length near the guess has
   * the tension or sag, if the ends are above each other along @p force, and what hang() throws.
   */
  double length_for_tension(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                            const Coordinates &force, double tension);
  double length_for_sag(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                        const Coordinates &force, double sag);

  /// The unstressed length [m] with which the cable passes through a place [m]. The place is in the
  /// plane of the ends and @p force, between the ends across @p force and below their straight
  /// line. Throws UserError for a place elsewhere, and without a force: the cable then is a
  /// straight line.
  double length_through(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                        const Coordinates &force, const Coordinates &place);
} // namespace taut

#endif
