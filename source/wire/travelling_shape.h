// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_travelling_shape_h
#define taut_travelling_shape_h

#include <taut/scene/expression.h>

#include <string>
#include <vector>

namespace taut
{
  /// The speed v of a formula of (s - v t) alone, written so [m/s]; 0: it is another one.
  double speed_of_shape(const std::string &formula);

  /**
   * Where a load q(s - v t) along a wire is zero, so that nobody integrates it there. Its shape is
   * looked at in bins, once each as they come onto the wire. What is narrower than a thousandth of
   * a bin may not be seen.
   */
  class TravellingShape
  {
  public:
    /// @p formula has this speed, above 0; @p end of the wire and @p width of a bin [m].
    TravellingShape(const Expression &formula, double speed, double end, double width);

    /// Whether the load is zero from @p a to @p b at the time t [m, s]; false for times before 0.
    bool is_zero(double a, double b, double t) const;

  private:
    bool look(long bin) const;

    Expression formula;
    double speed, end, width;

    /// By bins, from that at the end of the wire at t = 0 backwards: whether the load is not zero
    /// there.
    mutable std::vector<char> is_active;
    mutable std::vector<double> places, values; ///< of one bin
  };
} // namespace taut

#endif
