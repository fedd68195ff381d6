// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_element_load_h
#define taut_element_load_h

#include <taut/scene/expression.h>

#include <array>

namespace taut
{
  /// An element of a wire under a load, with its Gauss points.
  struct LoadedElement
  {
    static constexpr unsigned int n_points = 4;

    std::array<double, n_points> places; ///< [m]
    double begin, length;                ///< [m]
    unsigned int n_pieces;               ///< see LoadIntegral
  };

  /**
   * A load over one element as values at its four Gauss points. They are values of the load if the
   * Gauss rule gives its sum and first moment. Otherwise they are values of the cubic that has the
   * moments of the load against all cubics.
   */
  struct ElementLoad
  {
    static constexpr unsigned int n_points = LoadedElement::n_points;
    using Values = std::array<double, n_points>;

    /// Means over an element of the load times the Legendre polynomials of degree 0 to 3.
    using Moments = std::array<double, 4>;

    /// At a place on (-1, 1).
    static constexpr Moments legendre(const double x)
    {
      return {1., x, .5 * (3. * x * x - 1.), .5 * x * (5. * x * x - 3.)};
    }

    /// Replaces values by those of the cubic with these moments if their own moments differ by more
    /// than @p difference.
    void take_cubic(const Moments &moments, double difference);

    Values values = {};
    bool is_cubic = false;   ///< values of the cubic, not of the load
    double size = 0.;        ///< integral of the absolute value on an element of length 1
    double largest = 0.;     ///< absolute value
    bool begins = false;     ///< the load is not zero at the first end
    bool ends = false;       ///< the load is not zero at the last end
    bool is_resolved = true; ///< sum and first moment are within the tolerance
    double narrowest = 1.;   ///< length of the smallest piece that was looked at
    double narrowest_at = 0.;

    /// Width of a block of the same height and the same integral.
    double width() const { return largest > 0. ? size / largest : 0.; }
  };

  /**
   * A lower bound of the mean absolute value of a load along a wire at one time, from a few values:
   * a quarter of the value that a quarter of the wire exceeds. Computed at the first use.
   */
  class TypicalLoad
  {
  public:
    TypicalLoad(const Expression &magnitude, const double wire_length, const double t)
        : magnitude(magnitude), wire_length(wire_length), t(t)
    {
    }
    double operator()();

  private:
    const Expression &magnitude;
    double wire_length, t, value = -1.;
  };

  /**
   * Integrates a force per length q(s, t) over elements. An element is looked at in pieces, each
   * with the Gauss rule of four points and a nested rule of nine points. Pieces on which the two
   * rules differ are bisected. Nothing is allocated.
   */
  class LoadIntegral
  {
  public:
    /// Error of sum and first moment over the integral of |q|.
    static constexpr double tolerance = 1e-6;

    /// The same for an element that keeps its values at Gauss points.
    static constexpr double kept = .5 * tolerance;

    /// Error of a polynomial in its place, over the largest value near it, or over this part of the
    /// largest value on the wire.
    static constexpr double of_polynomial = .1 * tolerance, least_part = 1e-3;

    /// With one initial piece a detail of a fifth of an element is seen anywhere; with fine pieces
    /// a detail of a sixty-fourth.
    static constexpr unsigned int fine_pieces = 12;
    static constexpr double seen_at_once = 1. / 5., seen_by_fine_pieces = 1. / 64.;

    explicit LoadIntegral(const Expression &magnitude) : magnitude(magnitude) {}

    /// Over the element from @p begin, of length @p h, with the Gauss points @p places [m].
    ElementLoad over(double begin, double h, const std::array<double, 4> &places, double t,
                     unsigned int n_pieces, TypicalLoad &typical) const;

  private:
    struct Piece;
    struct Sums;
    void look(double begin, double h, double t, Piece &piece) const;
    void refine(double begin, double h, double t, const Piece &piece, Sums &sums) const;

    Expression magnitude;
  };
} // namespace taut

#endif
