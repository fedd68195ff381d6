// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_find_shape_h
#define taut_find_shape_h

#include <taut/cable/cable_elements.h>

#include <functional>
#include <vector>

namespace taut
{
  /// A stable equilibrium of a cable.
  struct CableShape
  {
    std::vector<double> positions; ///< one entry a DoF of CableElements [m, 1]
    unsigned int n_iterations = 0; ///< tangents that were factored
    double residual = 0.;          ///< largest unbalanced force [N, N m]
  };

  /**
   * The equilibrium of a cable under dead loads [N, N m], with the sorted DoFs @p held at their
   * values in @p start. Newton's method starts with an axial stiffness of 2 to 20 times @p tension
   * [N], which rises by factors of ten; with a tension of zero the stiffness is that of the cable
   * alone. Full steps come first, then a line search on the energy (Armijo). Where the tangent is
   * not definite, a semidefinite part of it with some mass gives a direction of descent. An
   * equilibrium whose tangent is not positive definite, such as a straight line under compression,
   * is no answer. Throws UserError if no equilibrium is found.
   */
  CableShape find_shape(const CableElements &cable, const std::vector<double> &start,
                        const std::vector<unsigned int> &held, const std::vector<double> &load,
                        double tension = 0.);

  /// The equilibrium between two places with hinges under a force per unstressed length [N/m]. The
  /// search starts from a parabola of the length of the cable, or from the straight line if this
  /// line is longer. Without a force, a cable as long as the straight line lies in it without
  /// tension; a longer cable has no shape of its own: UserError.
  CableShape hang(const CableElements &cable, const Coordinates &from, const Coordinates &to,
                  const Coordinates &force);

  /// Two ends count as above each other if they are beside a line along the load by at most this
  /// part of their distance, or of the length: a slack cable then has no plane to hang in.
  constexpr double above_each_other = 1e-6;

  /// Length along @p force of a cable that hangs from one end and is free at the other [m].
  double hanging_length(const CableElements &cable, const Coordinates &force);

  /// The shape of a cable that hangs from one end: a straight line whose tension falls to zero at
  /// the free end, exactly in equilibrium for the elements. The held end is at @p held; it is the
  /// last end if @p from_last, otherwise the first end. The force must not be zero.
  CableShape hang_freely(const CableElements &cable, const Coordinates &held, bool from_last,
                         const Coordinates &force);

  /// The component of the tension of a shape across @p force, along the chord [N]. It is constant
  /// along the cable; under weight alone it is the horizontal tension.
  double horizontal_tension(const CableElements &cable, const CableShape &shape,
                            const Coordinates &force);

  /// The largest distance of a shape from its chord, measured along @p force [m]; positive on the
  /// side that the force points to.
  double sag(const CableElements &cable, const CableShape &shape, const Coordinates &force);

  /// Distance of a shape below its chord, along @p force [m], at the part @p part_of_span in [0, 1]
  /// of the span across @p force.
  double depth_at(const CableElements &cable, const CableShape &shape, const Coordinates &force,
                  double part_of_span);

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
