// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_find_shape_h
#define taut_find_shape_h

#include <taut/cable/cable_elements.h>

#include <vector>

namespace taut
{
  /// A stable equilibrium of a cable.
  struct CableShape
  {
    std::vector<double> positions; ///< one entry a DoF of CableElements [m, 1]
    unsigned int n_iterations = 0; ///< tangents that were factored
    double residual = 0.;          ///< largest force that is not balanced [N, N m]
  };

  /**
   * The equilibrium of a cable under dead loads [N, N m], with the DoFs @p held where @p start has
   * them, sorted. Newton's method, from an axial stiffness of 2 to 20 times @p tension [N] upwards
   * by factors of ten; zero: with its own alone. Full steps come first, then those that lower the
   * energy enough (Armijo). Where the tangent is not definite, a semidefinite part of it with some
   * mass makes a direction of descent. An equilibrium whose tangent is not positive definite, such
   * as a straight line under compression, is no answer. Throws UserError if none is found.
   */
  CableShape find_shape(const CableElements &cable, const std::vector<double> &start,
                        const std::vector<unsigned int> &held, const std::vector<double> &load,
                        double tension = 0.);

  /// The same between two places, with hinges there, under a force per unstressed length [N/m]:
  /// from a parabola of the cable's length, or from the straight line if that is longer. Without a
  /// force a cable of just that length lies in the straight line, without tension, and a longer one
  /// has no shape of its own: UserError.
  CableShape hang(const CableElements &cable, const Coordinates &from, const Coordinates &to,
                  const Coordinates &force);

  /// The part of their distance, or of the length, by which two ends are beside a line along the
  /// load and count as above each other: so little gives a slack cable no plane to hang in.
  constexpr double above_each_other = 1e-6;

  /// How far a cable reaches along @p force that hangs from one end and is free at the other [m].
  double hanging_length(const CableElements &cable, const Coordinates &force);

  /// That cable, held at @p held, which is its last end if @p from_last, otherwise its first: a
  /// straight line with tension down to zero at the free end, exactly the one of the elements. The
  /// force is not zero.
  CableShape hang_freely(const CableElements &cable, const Coordinates &held, bool from_last,
                         const Coordinates &force);

  /// The component across @p force, along the chord, of the tension of a shape: the same all along
  /// the cable, and under weight alone what is called its horizontal tension [N].
  double horizontal_tension(const CableElements &cable, const CableShape &shape,
                            const Coordinates &force);

  /// The largest distance of a shape from its chord, measured along @p force, positive where the
  /// shape is on the side that the force points to [m].
  double sag(const CableElements &cable, const CableShape &shape, const Coordinates &force);

  /// How far a shape is below its chord, along @p force, at a part of the span across it, in
  /// [0, 1] [m].
  double depth_at(const CableElements &cable, const CableShape &shape, const Coordinates &force,
                  double part_of_span);
} // namespace taut

#endif
