// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_pivots_h
#define taut_pivots_h

namespace taut
{
  /// Pivots over their diagonal entries, below which a row of F or of a coarse problem depends on
  /// those before it: rounding leaves about n 1e-16 of a dependent one.
  constexpr double dependent_pivot = 1e-12;

  /// The same below which nothing holds a motion of a body: a few roundings, as pivots of long and
  /// soft bodies that are held are small, too. FactoredStructure measures the digits that these
  /// lose.
  constexpr double free_pivot = 1e-15;

  /// Relative shift of a matrix of dependent rows, above rounding.
  constexpr double dependence_shift = dependent_pivot;
} // namespace taut

#endif
