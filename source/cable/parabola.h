// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_parabola_h
#define taut_parabola_h

#include <taut/cable/cable_elements.h>

#include <vector>

namespace taut
{
  /// A unit vector along @p a, or zero.
  Coordinates unit_or_zero(const Coordinates &a);

  /// A parabola over t in [0, 1] from its first point on: the start of searches for the shape of a
  /// cable.
  struct Parabola
  {
    Coordinates chord, down;
    double depth; ///< below the middle of the chord, along `down` [m]

    Coordinates at(double t) const;
    Coordinates derivative(double t) const;
    double length() const; ///< [m]

    /// Arc length at n + 1 values of t [m].
    std::vector<double> arc_lengths(unsigned int n) const;

    /// Positions of a cable that lies evenly stretched along the parabola, starting at @p from.
    std::vector<double> positions(const CableElements &cable, const Coordinates &from) const;
  };

  /// The parabola of this length between two points, or the straight line if the line is longer.
  Parabola parabola(const Coordinates &chord, const Coordinates &down, double length);
} // namespace taut

#endif
