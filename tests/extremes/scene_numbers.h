// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_scene_numbers_h
#define taut_extremes_scene_numbers_h

#include "observation.h"

namespace extremes
{
  /// Factors of the units of length, mass and time.
  struct Units
  {
    double length = 1., mass = 1., time = 1.;

    /// Of a number with these powers of length, mass and time.
    double of(int l, int m, int t) const;
  };

  /// The same case in other units: all its numbers are multiplied as their dimension says.
  Case in_units(const Case &c, const Units &units);

  /// The observations of that case back in the units of the first one.
  void to_units_of_origin(std::vector<Observation> &steps, const Units &units);

  /// By up to two units in the last place, which are the same for equal numbers.
  void change_last_digit(double &x, unsigned int seed);

  /// A neighbour in the numbers of double precision: stiffnesses, masses, loads, gaps and so on
  /// change by up to two units in the last place. Numbers that are equal stay equal, so that
  /// duplicated constraints stay duplicates; places stay, so that nodes stay one node.
  Case in_last_digits(const Case &c, unsigned int seed);
} // namespace extremes

#endif
