// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_coordinates_h
#define taut_coordinates_h

#include <cmath>

namespace taut
{
  /// A point [m] or a direction in space: x along the line, y upwards, z out of the plane; z = 0 in
  /// a plane scene. Each body says what its places mean: the first coordinate of a place on a wire
  /// is the position along it.
  struct Coordinates
  {
    double x = 0., y = 0., z = 0.;

    double operator[](const unsigned int i) const { return i == 0 ? x : i == 1 ? y : z; }
  };

  inline double dot(const Coordinates &a, const Coordinates &b)
  {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }

  inline Coordinates operator-(const Coordinates &a, const Coordinates &b)
  {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }

  /// @p a + s @p b
  inline Coordinates add_scaled(const Coordinates &a, const double s, const Coordinates &b)
  {
    return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
  }

  inline Coordinates cross(const Coordinates &a, const Coordinates &b)
  {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }

  inline double norm(const Coordinates &a)
  {
    return std::hypot(std::hypot(a.x, a.y), a.z);
  }

  inline bool operator==(const Coordinates &a, const Coordinates &b)
  {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
} // namespace taut

#endif
