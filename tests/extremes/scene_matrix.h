// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_scene_matrix_h
#define taut_extremes_scene_matrix_h

#include "observation.h"

namespace extremes
{
  /// Families of small cases, each a pairwise cover of its dimensions. Other seeds, other covers.
  std::vector<Case> masses(unsigned int seed); ///< springs, stops and droppers on a chain of masses
  std::vector<Case> wires(unsigned int seed);  ///< one wire, its ends, stops between
  std::vector<Case> sliding(unsigned int seed); ///< a mass that slides along a wire
  std::vector<Case> resting(unsigned int seed); ///< statics of bodies that only links hold

  /// Rows and bodies that have no answer: contradictory, or not held.
  std::vector<Case> impossible();
} // namespace extremes

#endif
