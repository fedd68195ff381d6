// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_tests_elastic_catenary_h
#define taut_tests_elastic_catenary_h

#include "common.h"

#include <taut/base/coordinates.h>

/// The elastic catenary in closed form (Irvine, Cable Structures, 1981, section 1.3) between two
/// places, in the plane of chord and load: forces H across it and V against it at the first end.
class ElasticCatenary
{
public:
  ElasticCatenary(const taut::Coordinates &from, const taut::Coordinates &to,
                  const taut::Coordinates &load, const double EA, const double length)
      : from(from), EA(EA), length(length), w(norm(load)), down(add_scaled({}, 1. / w, load))
  {
    const taut::Coordinates chord = to - from, level = add_scaled(chord, -dot(chord, down), down);
    across = add_scaled({}, 1. / norm(level), level);
    const double l = norm(level), depth = dot(chord, down), distance = norm(chord);
    // A parabola, or a taut line that its own stretch lets down.
    const double stretch = distance / length - 1.;
    H = EA * (std::cbrt(std::pow(w * l / EA, 2) / 24.) + std::fmax(0., stretch));
    if (stretch < 0.)
      H = std::fmin(H, w * l / std::sqrt(-24. * stretch));
    V = .5 * w * length - H * depth / l;
    for (int k = 0; k < 200; ++k)
    {
      const double x = across_at(length) - l, y = down_at(length) - depth;
      const double dH = 1e-7 * H, dV = 1e-7 * (std::fabs(V) + H);
      const ElasticCatenary a = with(H + dH, V), b = with(H, V + dV);
      const ElasticCatenary c = with(H - dH, V), d = with(H, V - dV);
      const double xH = (a.across_at(length) - c.across_at(length)) / (2. * dH),
                   xV = (b.across_at(length) - d.across_at(length)) / (2. * dV),
                   yH = (a.down_at(length) - c.down_at(length)) / (2. * dH),
                   yV = (b.down_at(length) - d.down_at(length)) / (2. * dV),
                   det = xH * yV - xV * yH;
      const double step_H = (-x * yV + y * xV) / det, step_V = (-y * xH + x * yH) / det;
      const double kept = step_H < -.5 * H ? -.5 * H / step_H : 1.;
      H += kept * step_H;
      V += kept * step_V;
    }
    error = std::hypot(across_at(length) - l, down_at(length) - depth);
  }

  taut::Coordinates position(const double s) const
  {
    return add_scaled(add_scaled(from, across_at(s), across), down_at(s), down);
  }

  /// Of the first end [N].
  double end_force() const { return std::hypot(H, V); }
  double horizontal() const { return H; }

  /// Of the cable at its first end [N].
  taut::Coordinates pull() const { return add_scaled(add_scaled({}, H, across), V, down); }

  double error = 0.; ///< [m]

private:
  double across_at(const double s) const
  {
    return H * s / EA + H / w * (std::asinh(V / H) - std::asinh((V - w * s) / H));
  }
  double down_at(const double s) const
  {
    return s / EA * (V - .5 * w * s) + (std::hypot(H, V) - std::hypot(H, V - w * s)) / w;
  }
  ElasticCatenary with(const double other_H, const double other_V) const
  {
    ElasticCatenary other = *this;
    other.H = other_H;
    other.V = other_V;
    return other;
  }

  taut::Coordinates from;
  double EA, length, w, H = 0., V = 0.;
  taut::Coordinates down, across;
};

#endif
