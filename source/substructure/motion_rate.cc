// SPDX-License-Identifier: LGPL-2.1-or-later
#include "substructure/motion_rate.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace taut
{
  namespace
  {
    /// Distance of the first differences as a part of a step: for a motion with 20 steps a period
    /// the rate is right to 1e-7.
    constexpr double first_distance = 1. / 16.;

    /// Halvings of this distance: down to 4e-9 of a step.
    constexpr int most_halvings = 24;

    /// Part of the rates inside of the differences by which two of them may differ on a smooth
    /// motion: that of a sine is less for 6 steps a period and more.
    constexpr double smooth = 1e-3;

    /// Roundings of the times and values in a difference.
    constexpr double rounding = 16. * std::numeric_limits<double>::epsilon();

    struct Rate
    {
      double value = 0.;
      double distance = 0.;   ///< of the values that decided; negative: before the time [s]
      bool is_smooth = false; ///< false: there is a jump within the distance
    };

    /// One-sided differences of second order at two distances, extrapolated to third order. Halves
    /// the distances until no kink lies inside.
    Rate one_sided_rate(const std::function<double(double)> &u, const double t, const double first)
    {
      double h = first;
      const double u0 = u(t);
      double whole = u(t + h), twice = u(t + 2. * h);
      for (int n = 0;; ++n)
      {
        const double half = u(t + .5 * h), coarse = (4. * (whole - u0) - (twice - u0)) / (2. * h),
                     fine = (4. * (half - u0) - (whole - u0)) / h,
                     scale = std::max({std::fabs(half - u0), std::fabs(whole - half),
                                       .5 * std::fabs(twice - whole)}) *
                             2. / std::fabs(h),
                     noise = rounding * (std::fabs(u0) + std::fabs(twice) + std::fabs(t) * scale) /
                             std::fabs(h);
        const bool is_smooth = std::fabs(fine - coarse) <= smooth * scale + noise;
        if (is_smooth || n == most_halvings || std::fabs(h) <= rounding * std::fabs(t))
          return {(4. * fine - coarse) / 3., h, is_smooth};
        h *= .5;
        twice = whole;
        whole = half;
      }
    }

    /// The rate behind a jump next to @p t, too.
    double rate_on_side(const std::function<double(double)> &u, const double t, const double first)
    {
      const Rate at = one_sided_rate(u, t, first);
      if (at.is_smooth)
        return at.value;
      const Rate behind = one_sided_rate(u, t + 4. * at.distance, first);
      return behind.is_smooth ? behind.value : 0.;
    }
  } // namespace

  double rate_of_motion(const std::function<double(double)> &u, const double t, const double step)
  {
    const double first = first_distance * step;
    try
    {
      return rate_on_side(u, t, first);
    }
    catch (const std::exception &) // a table that ends here
    {
      return rate_on_side(u, t, -first);
    }
  }

  JumpOfMotion find_jump(const std::function<double(double)> &u, const double begin,
                         const double end, const double way, const double lack)
  {
    // Part of the way that lacks on a smooth motion: less for 13 steps a period and more, (omega
    // step)^2 / 12. Part of the lack that remains between times that are almost equal if there is a
    // jump. Bisections down to 1e-12 of the step.
    constexpr double conspicuous = .02, most = .5;
    constexpr int most_bisections = 40;
    if (!(std::fabs(lack) > conspicuous * std::fabs(way)))
      return {};
    double a = begin, b = end, at_a = u(a), at_b = u(b);
    if (std::fabs(lack) <= rounding * (std::fabs(at_a) + std::fabs(at_b)))
      return {};
    for (int n = 0; n < most_bisections && b - a > rounding * std::fabs(b); ++n)
    {
      const double middle = .5 * (a + b), value = u(middle);
      const bool first = std::fabs(value - at_a) > std::fabs(at_b - value);
      (first ? b : a) = middle;
      (first ? at_b : at_a) = value;
    }
    return std::fabs(at_b - at_a) >= most * std::fabs(lack) ? JumpOfMotion{b, at_b - at_a}
                                                            : JumpOfMotion{};
  }
} // namespace taut
