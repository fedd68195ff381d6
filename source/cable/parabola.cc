// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/parabola.h"

#include <algorithm>
#include <cstddef>

namespace taut
{
  namespace
  {
    constexpr unsigned int n_points = 1000;
  }

  Coordinates unit_or_zero(const Coordinates &a)
  {
    const double size = norm(a);
    return size == 0. ? a : Coordinates{a.x / size, a.y / size, a.z / size};
  }

  Coordinates Parabola::at(const double t) const
  {
    return add_scaled(add_scaled({}, t, chord), 4. * depth * t * (1. - t), down);
  }

  Coordinates Parabola::derivative(const double t) const
  {
    return add_scaled(chord, 4. * depth * (1. - 2. * t), down);
  }

  double Parabola::length() const
  {
    return arc_lengths(n_points).back();
  }

  std::vector<double> Parabola::arc_lengths(const unsigned int n) const
  {
    std::vector<double> s = {0.};
    for (unsigned int i = 0; i < n; ++i)
      s.push_back(s.back() + norm(derivative((i + .5) / n)) / n);
    return s;
  }

  std::vector<double> Parabola::positions(const CableElements &cable, const Coordinates &from) const
  {
    const std::vector<double> arc = arc_lengths(n_points);
    const double scale = arc.back() / cable.length();
    const auto parameter = [&](const double s)
    {
      const auto next = std::clamp<std::ptrdiff_t>(
          std::upper_bound(arc.begin(), arc.end(), s * scale) - arc.begin(), 1, n_points);
      return (next - 1 + (s * scale - arc[next - 1]) / (arc[next] - arc[next - 1])) / n_points;
    };
    return cable.interpolate([&](const double s) { return add_scaled(from, 1., at(parameter(s))); },
                             [&](const double s) {
                               return add_scaled({}, scale, unit_or_zero(derivative(parameter(s))));
                             });
  }

  Parabola parabola(const Coordinates &chord, const Coordinates &down, const double length)
  {
    if (length <= norm(chord))
      return {chord, down, 0.};
    double low = 0., high = length;
    for (int k = 0; k < 50; ++k)
    {
      const double depth = .5 * (low + high);
      (Parabola{chord, down, depth}.length() < length ? low : high) = depth;
    }
    return {chord, down, high};
  }
} // namespace taut
