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
   * The force of a spring as a strictly increasing function of its elongation, or compression, u:
   * f(0) = 0, and f(-u) = -f(u). A derived class says what it is for u >= 0. Lengths are in m and
   * forces in N, or in rad and N m.
   */
  class ForceLaw
  {
  public:
    virtual ~ForceLaw() = default;

    /// f(u) [N, N m].
    double force(double u) const { return u < 0. ? -value(-u) : value(u); }

    /// The derivative f'(u), not negative; at a kink that of one side [N/m, N m/rad].
    double stiffness(double u) const { return slope(u < 0. ? -u : u); }

    /// The largest f' where the law is meant to be used, positive [N/m, N m/rad].
    virtual double largest_stiffness() const = 0;

    /// The mean of f between two elongations: what is stored between a and b is (b - a) times this,
    /// without the cancellation of a difference [N, N m].
    double mean_force(double a, double b) const;

    /// The energy that is stored, the integral of f from 0 to u [J].
    double energy(double u) const { return u * mean_force(0., u); }

    /// The elongation under a force, the inverse of f [m, rad].
    double elongation(double N) const;

    /// What it is, with all its numbers, in a few words.
    virtual std::string description() const = 0;

  private:
    virtual double value(double u) const = 0;
    virtual double slope(double u) const = 0;

    /// The mean of f over [a, b], 0 <= a < b.
    virtual double mean(double a, double b) const = 0;
  };

  /// A law that is linear between points, and beyond the last one as it is before it.
  class TableLaw : public ForceLaw
  {
  public:
    /// Elongations and forces, the origin not among them; throws std::invalid_argument unless both
    /// are finite and increase, from above zero.
    explicit TableLaw(const std::vector<std::pair<double, double>> &points);

    double largest_stiffness() const override;
    std::string description() const override;

  private:
    std::size_t segment(double u) const;
    double value(double u) const override;
    double slope(double u) const override;
    double mean(double a, double b) const override;

    std::vector<double> u, f, k; ///< where segments begin, and their slopes
  };

  /// The root of an increasing function between @p a and @p b, to rounding; the end where it is
  /// smaller in size if it has one sign there.
  double increasing_root(const std::function<double(double)> &function, double a, double b);
} // namespace taut

#endif
