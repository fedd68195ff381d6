// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_travelling_shape_h
#define taut_travelling_shape_h

#include <taut/scene/expression.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace taut
{
  /**
   * A function q(s - x(t)) that travels along a wire without changing its shape. The shape is
   * looked at once as it comes onto the wire, and kept as polynomials of degree 5 on pieces, which
   * are bisected around kinks and jumps.
   *
   * Bins of some elements are looked at one after the other, at 250 places for each element:
   * narrower details may not be seen. What a place gets depends on t alone, not on earlier calls.
   */
  class TravellingShape
  {
  public:
    static constexpr unsigned int degree = 5;

    /// The elements lie from @p begin to @p end of a wire of this length and have this mean length
    /// [m].
    TravellingShape(const Expression::Separated::Shape &shape, double wire_length, double begin,
                    double end, double element_length);

    /// Values along the wire, at one time.
    class Walk;

  private:
    static constexpr unsigned int n_coefficients = degree + 1;

    /// Places in a bin are parts of its width, in the direction against s.
    struct Piece
    {
      double begin, end;
      double reach; ///< up to which the polynomial is good beyond both ends
      bool is_zero;
      std::array<double, n_coefficients> coefficients; ///< of powers of the part of the piece

      double operator()(double u) const { return at_part((u - begin) / (end - begin)); }

      double at_part(const double x) const
      {
        double result = coefficients.back();
        for (unsigned int j = n_coefficients - 1; j-- > 0;)
          result = result * x + coefficients[j];
        return result;
      }
    };
    struct Bin
    {
      bool is_known = false;
      double narrow = -1.; ///< where one place alone sees a load; below 0: nowhere
      std::vector<Piece> pieces;
    };

    const Bin &bin(long number) const;
    Bin look(long bin) const;
    bool resolve(long bin, double begin, double end, double most, Bin &result) const;
    bool is_good(const Piece &piece, double begin, double end, double accepted) const;
    void evaluate(double bin, const std::vector<double> &u, std::vector<double> &values) const;
    double largest_of(const std::vector<double> &values) const;

    Expression::Separated::Shape shape;
    double a, b;                 ///< at t = 0
    double width, first;         ///< of bins; the end of the first bin at t = 0 [m]
    double largest = 0.;         ///< absolute value on the wire and as far off it at the start
    std::vector<double> samples; ///< places in a bin, and in an element before and behind it

    mutable std::unordered_map<long, Bin> bins;
    mutable std::vector<double> sampled, places, points, values;
  };

  class TravellingShape::Walk
  {
  public:
    /// At the time t [s]; @p shape is kept by reference.
    Walk(const TravellingShape &shape, double t);

    /// Goes to the piece at s [m]. False if the shape is not known there: where the formula has no
    /// value, and where too many pieces do not resolve it.
    bool go_to(double s);

    /// Goes on to the next piece along the wire. False as go_to().
    bool advance();

    /// Ends of the piece [m].
    double begin() const { return from; }
    double end() const { return to; }

    /// Whether the polynomial of the piece is good from s0 to s1, which may reach over its ends.
    bool covers(const double s0, const double s1) const { return s0 >= low && s1 <= high; }

    bool is_zero() const { return piece->is_zero; }

    /// Whether only one of the places that are looked at sees something, and lies from s0 to s1 in
    /// the bin of this piece.
    bool is_narrow(const double s0, const double s1) const { return narrow >= s0 && narrow <= s1; }

    /// Value where the piece covers s.
    double operator()(const double s) const { return piece->at_part((to - s) * per_piece); }

  private:
    bool enter(long bin);
    void set_ends();

    const TravellingShape &shape;
    double start, width, per_length; ///< where bin 0 ends at this time, width of bins [m, 1/m]
    long number = 0;                 ///< of the bin
    const Bin *bin = nullptr;
    const Piece *piece = nullptr;
    double from = 0., to = -1., narrow = 0.; ///< [m]
    double low = 0., high = -1.;             ///< to where the piece is good [m]
    double per_piece = 0.;                   ///< pieces in a metre
  };
} // namespace taut

#endif
