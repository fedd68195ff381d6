// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_travelling_shape_h
#define taut_travelling_shape_h

#include "wire/element_load.h"
#include <taut/scene/expression.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /// The speed b / a of a formula of (a*s - b*t) alone, written so, with or without the factors and
  /// as quotients, too [m/s]; 0: it is another one.
  double speed_of_shape(const std::string &formula);

  /**
   * A force per length q(s - v t) that travels along a wire without changing its shape. The shape
   * is looked at once as it comes onto the wire, and kept as polynomials of degree 5 on pieces,
   * which are bisected around kinks and jumps. An element takes its integrals from them.
   *
   * Bins of some elements are looked at one after the other, at 250 places for each element:
   * narrower details may not be seen. What an element gets depends on t alone, not on earlier
   * calls.
   */
  class TravellingShape
  {
  public:
    /// @p formula has this speed, above 0; the elements lie from @p begin to @p end of a wire of
    /// this length and have this mean length [m/s, m].
    TravellingShape(const Expression &formula, double speed, double wire_length, double begin,
                    double end, double element_length);

    /// The load of elements one after the other along the wire, at one time.
    class Walk;

  private:
    static constexpr unsigned int n_coefficients = 6;

    /// Places in a bin are parts of its width, in the direction against s.
    struct Piece
    {
      double begin, end;
      bool is_zero;
      std::array<double, n_coefficients> coefficients; ///< of powers of the part of the piece

      double operator()(double u) const
      {
        const double x = (u - begin) / (end - begin);
        double result = coefficients.back();
        for (unsigned int j = n_coefficients - 1; j-- > 0;)
          result = result * x + coefficients[j];
        return result;
      }
    };
    struct Bin
    {
      bool is_looked_at = false, is_known = false;
      double narrow = -1.; ///< where one place alone sees a load; below 0: nowhere
      std::vector<Piece> pieces;
    };

    Bin look(std::size_t bin) const;
    bool resolve(std::size_t bin, double begin, double end, double most, Bin &result) const;
    void evaluate(double bin, const std::vector<double> &u, std::vector<double> &values) const;
    double largest_of(const std::vector<double> &values) const;

    Expression formula;
    double speed, width, first;  ///< first: the end of the first bin at t = 0 [m]
    double largest = 0.;         ///< absolute value on the wire and as far behind it at the start
    std::vector<double> samples; ///< places in a bin

    mutable std::vector<Bin> bins;
    mutable std::vector<double> sampled, places, points, values;
  };

  class TravellingShape::Walk
  {
  public:
    /// At the time t [s]; @p shape is kept by reference.
    Walk(const TravellingShape &shape, double t);

    /// The load of the next element, with its values; its size is 0 where these are. False if the
    /// shape is not known there: at times before 0, where the formula has no value, and where too
    /// many pieces do not resolve it. A load that one place alone sees is not resolved.
    bool on(const LoadedElement &element, ElementLoad &load);

  private:
    double place(const double s) const { return std::max(0., start - s * per_length); }
    bool move_to(double u);
    void integrate(const LoadedElement &element, double u0, double u1, ElementLoad &load);

    const TravellingShape &shape;
    double start, per_length; ///< places of s = 0 and of a metre, in bins
    bool is_before;
    std::size_t bin = 0, piece = 0; ///< of the last place
    double from = 0., to = -1.;     ///< the ends of its piece
  };
} // namespace taut

#endif
