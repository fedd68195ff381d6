// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_strained_body_h
#define taut_strained_body_h

#include <taut/base/coordinates.h>

#include <vector>

namespace taut
{
  /// Strains above this are not small: terms of second order change stresses by some five per cent.
  constexpr double small_strain = .05;

  /// How a body, or a part of it, is strained.
  struct Straining
  {
    double energy = 0.; ///< of the strains [J]
    double large = 0.;  ///< the part of it where a principal strain exceeds small_strain [J]

    /// The part of it that elements with all modes of bending would not store under the same
    /// displacement of their nodes; of simplices an estimate from the energy that they lack [J].
    double locked = 0.;

    double strain = 0.; ///< the largest magnitude of a principal strain
    Coordinates place;  ///< of this strain [m]
  };

  /// A second base of a Substructure of small strains, so that a run warns of strains that are
  /// large and of elements that lock.
  class StrainedBody
  {
  public:
    virtual ~StrainedBody() = default;

    /// At a displacement U from the undeformed body [m].
    virtual Straining straining(const std::vector<double> &U) const = 0;
  };
} // namespace taut

#endif
