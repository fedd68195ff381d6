// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_force_law_h
#define taut_force_law_h

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /**
   * The force of a spring as a strictly increasing function f of its elongation, or compression, u:
   * f(0) = 0, and f(-u) = -f(u). Derive from it to give a link a law of your own, with f for u >=
   * 0; TableLaw is a law by points. Lengths are in m and forces in N, or in rad and N m.
   */
  class ForceLaw
  {
  public:
    virtual ~ForceLaw() = default;

    /// f(u) [N, N m].
    double force(double u) const { return u < 0. ? -value(-u) : value(u); }

    /// The derivative f'(u), not negative; at a kink the derivative of one side [N/m, N m/rad].
    double stiffness(double u) const { return slope(u < 0. ? -u : u); }

    /// The largest f' in the range of use, positive [N/m, N m/rad].
    virtual double largest_stiffness() const = 0;

    /// The mean of f between two elongations [N, N m]. The energy between a and b is (b - a) times
    /// the mean, without the cancellation of a difference.
    double mean_force(double a, double b) const;

    /// The stored energy, the integral of f from 0 to u [J].
    double energy(double u) const { return u * mean_force(0., u); }

    /// The elongation under a force, the inverse of f [m, rad].
    double elongation(double N) const;

    /// A short description of the law with all its numbers.
    virtual std::string description() const = 0;

    /// Entries of a link, and their values, from which this law is read back to the last bit; none
    /// if no entries say it.
    virtual std::vector<std::pair<std::string, std::string>> entries() const { return {}; }

  private:
    virtual double value(double u) const = 0;
    virtual double slope(double u) const = 0;

    /// The mean of f over [a, b], 0 <= a < b.
    virtual double mean(double a, double b) const = 0;
  };

  /// A law that is linear between points, and beyond the last point as before it.
  class TableLaw : public ForceLaw
  {
  public:
    /// Elongations and forces without the origin. Throws std::invalid_argument unless both are
    /// finite and increase, from above zero.
    explicit TableLaw(const std::vector<std::pair<double, double>> &points);

    double largest_stiffness() const override;
    std::string description() const override;
    std::vector<std::pair<std::string, std::string>> entries() const override;

  private:
    std::string points(int digits) const;
    std::size_t segment(double u) const;
    double value(double u) const override;
    double slope(double u) const override;
    double mean(double a, double b) const override;

    std::vector<double> u, f, k; ///< starts of the segments, and their slopes
  };

  /// The root of an increasing function between @p a and @p b, to rounding. If the function has one
  /// sign there, the end with the smaller absolute value.
  double increasing_root(const std::function<double(double)> &function, double a, double b);
} // namespace taut

#endif
