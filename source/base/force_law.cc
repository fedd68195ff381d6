// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/force_law.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace taut
{
  double ForceLaw::mean_force(const double a, const double b) const
  {
    if (a == b)
      return force(a);
    // The energy is even: with two signs, only the energy between the two absolute values counts.
    const double u = std::fabs(a), v = std::fabs(b), low = std::min(u, v), high = std::max(u, v);
    if (low == high)
      return 0.;
    const double of_sizes = mean(low, high);
    if (a >= 0. && b >= 0.)
      return of_sizes;
    if (a <= 0. && b <= 0.)
      return -of_sizes;
    return (v - u) / (b - a) * of_sizes;
  }

  double ForceLaw::elongation(const double N) const
  {
    if (N < 0.)
      return -elongation(-N);
    if (N == 0.)
      return 0.;
    double end = N / largest_stiffness();
    while (value(end) < N)
      end *= 2.;
    return increasing_root([&](const double u) { return value(u) - N; }, 0., end);
  }

  TableLaw::TableLaw(const std::vector<std::pair<double, double>> &points) : u{0.}, f{0.}
  {
    for (const auto &[elongation, N] : points)
    {
      if (!std::isfinite(elongation) || !std::isfinite(N) || !(elongation > u.back()) ||
          !(N > f.back()))
        throw std::invalid_argument("the points of a law increase from zero");
      k.push_back((N - f.back()) / (elongation - u.back()));
      u.push_back(elongation);
      f.push_back(N);
    }
    if (k.empty())
      throw std::invalid_argument("a law has a point");
    k.push_back(k.back());
  }

  double TableLaw::largest_stiffness() const
  {
    return *std::max_element(k.begin(), k.end());
  }

  std::string TableLaw::points(const int digits) const
  {
    std::ostringstream out;
    out.precision(digits);
    for (std::size_t i = 1; i < u.size(); ++i)
      out << (i > 1 ? ", " : "") << u[i] << ':' << f[i];
    return out.str();
  }

  std::string TableLaw::description() const
  {
    return "table " + points(15);
  }

  std::vector<std::pair<std::string, std::string>> TableLaw::entries() const
  {
    return {{"Law", "table"}, {"Law points", points(17)}};
  }

  std::size_t TableLaw::segment(const double at) const
  {
    if (at < u[1])
      return 0;
    return std::upper_bound(u.begin(), u.end(), at) - u.begin() - 1;
  }

  double TableLaw::value(const double at) const
  {
    const std::size_t i = segment(at);
    return f[i] + k[i] * (at - u[i]);
  }

  double TableLaw::slope(const double at) const
  {
    return k[segment(at)];
  }

  /// Trapezoids.
  double TableLaw::mean(const double a, const double b) const
  {
    double sum = 0., begin = a, force_at_begin = value(a);
    for (std::size_t i = segment(a) + 1; i < u.size() && u[i] < b; ++i)
    {
      sum += .5 * (force_at_begin + f[i]) * (u[i] - begin);
      begin = u[i];
      force_at_begin = f[i];
    }
    if (begin == a)
      return .5 * (force_at_begin + value(b));
    return (sum + .5 * (force_at_begin + value(b)) * (b - begin)) / (b - a);
  }

  double increasing_root(const std::function<double(double)> &function, const double a,
                         const double b)
  {
    const double at_a = function(a), at_b = function(b);
    if (!(at_a < 0.) || !(at_b > 0.))
      return std::fabs(at_a) <= std::fabs(at_b) ? a : b;
    std::uintmax_t n = 200;
    const auto found = boost::math::tools::toms748_solve(
        function, a, b, at_a, at_b, boost::math::tools::eps_tolerance<double>(52), n);
    return .5 * (found.first + found.second);
  }
} // namespace taut
