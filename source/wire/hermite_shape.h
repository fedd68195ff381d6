// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hermite_shape_h
#define taut_hermite_shape_h

#include <array>

namespace taut
{
  /**
   * The four cubic Hermite shape functions of one cell in one point, with their derivatives with
   * respect to arc length. Order of the DoFs: value and slope at the first vertex, value and slope
   * at the second one.
   */
  struct HermiteShape
  {
    std::array<double, 4> value;     ///< [1, m, 1, m]
    std::array<double, 4> slope;     ///< [1/m, 1, 1/m, 1]
    std::array<double, 4> curvature; ///< [1/m^2, 1/m, 1/m^2, 1/m]
  };

  /**
   * The shape functions of a cell of length @p h [m] at xi in [0, 1], counted from the cell's first
   * vertex. Use it in inner loops: the compiler drops values that the caller does not use.
   */
  inline HermiteShape hermite_shape(const double h, const double xi)
  {
    const double eta = 1 - xi;
    const double per_h = 1 / h;
    const double bend = 6 * (xi - eta) * per_h * per_h;
    return {{{eta * eta * (1 + 2 * xi), h * xi * eta * eta, xi * xi * (1 + 2 * eta),
              -h * xi * xi * eta}},
            {{-6 * xi * eta * per_h, eta * (1 - 3 * xi), 6 * xi * eta * per_h, xi * (1 - 3 * eta)}},
            {{bend, (6 * xi - 4) * per_h, -bend, (6 * xi - 2) * per_h}}};
  }
} // namespace taut

#endif
