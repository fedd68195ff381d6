// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_travelling_shape_h
#define taut_travelling_shape_h

#include "wire/element_load.h"
#include <taut/scene/expression.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace taut
{
  /// The speed v of a formula of (s - v t) alone, written so [m/s]; 0: it is another one.
  double speed_of_shape(const std::string &formula);

  /**
   * A force per length q(s - v t) that travels along a wire without changing its shape. The shape
   * is looked at once as it comes onto the wire, and kept as polynomials of degree 5 on pieces,
   * which are bisected around kinks and jumps. An element takes its integrals from them.
   *
   * Bins of some elements are looked at one after the other, at a thousand places for each element:
   * narrower details may not be seen. What it returns depends on t alone, not on earlier calls.
   */
  class TravellingShape
  {
  public:
    /// Error of a polynomial over the largest value in its bin.
    static constexpr double tolerance = 1e-7;

    /// @p formula has this speed, above 0; the elements lie from @p begin to @p end of a wire of
    /// this length and have this mean length [m/s, m].
    TravellingShape(const Expression &formula, double speed, double wire_length, double begin,
                    double end, double element_length);

    /// The load of an element at the time t [s], with its values; its size is 0 where these are.
    /// Empty if the shape is not known: at times before 0, where the formula has no value, and
    /// where too many pieces do not resolve it.
    std::optional<ElementLoad> on(const LoadedElement &element, double t) const;

  private:
    static constexpr unsigned int n_coefficients = 6;

    /// Places in a bin are parts of its width, in the direction against s.
    struct Piece
    {
      double begin, end;
      bool is_zero;
      std::array<double, n_coefficients> coefficients; ///< of powers of the part of the piece

      double operator()(double u) const;
    };
    struct Bin
    {
      bool is_known = false;
      std::vector<Piece> pieces;

      const Piece &at(double u) const;
    };

    Bin look(std::size_t bin) const;
    bool resolve(std::size_t bin, double begin, double end, double largest, Bin &result) const;
    void know(std::size_t bin) const;
    void evaluate(std::size_t bin, const std::vector<double> &u, std::vector<double> &values) const;

    Expression formula;
    double speed, width, first; ///< first: the end of the first bin at t = 0 [m]

    mutable std::vector<Bin> bins;
    mutable double largest = 0.; ///< of the absolute values in the bins so far
    std::vector<double> samples; ///< places in a bin
    mutable std::vector<double> sampled, places, points, values;
  };
} // namespace taut

#endif
