// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/parabola.h"

#include "base/text.h"
#include "cable/find_length.h"
#include <taut/base/exceptions.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <string>

namespace taut
{
  namespace
  {
    /// The length at which @p quantity, a monotonic function of the length, is zero; @p guess is
    /// near.
    template <typename Quantity>
    double find_length(const Quantity &quantity, const double guess, const std::string &name)
    {
      double low = guess, high = guess, at_low = quantity(guess), at_high = at_low;
      for (double width = 1e-4; at_low * at_high > 0.; width *= 4.)
      {
        if (width > .8)
          throw UserError("no unstressed length near " + to_text(guess) + " m gives the " + name +
                          "; give the length itself");
        low = guess * (1. - width);
        high = guess * (1. + width);
        at_low = quantity(low);
        at_high = quantity(high);
      }
      if (!std::isfinite(at_low * at_high))
        throw UserError("the " + name +
                        " is beyond the range of numbers; take less extreme values");
      if (at_low == 0.)
        return low;
      if (at_high == 0.)
        return high;
      std::uintmax_t n = 100;
      const auto found = boost::math::tools::toms748_solve(
          quantity, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(46), n);
      return .5 * (found.first + found.second);
    }

    /// The unstressed length of a parabola of this horizontal tension, or without @p depth.
    double length_of_parabola(const CableElements &cable, const Coordinates &chord,
                              const Coordinates &force, const double depth, const double tension)
    {
      const Parabola shape{chord, unit_or_zero(force), depth};
      const double length = shape.length(),
                   span = norm(add_scaled(chord, -dot(chord, shape.down), shape.down)),
                   mean = tension * length / span;
      return length / (1. + mean / cable.section().axial_stiffness);
    }

    double span_of(const Coordinates &from, const Coordinates &to, const Coordinates &force)
    {
      const Coordinates chord = to - from, down = unit_or_zero(force);
      const double span = norm(add_scaled(chord, -dot(chord, down), down));
      if (!(span > 1e-9 * norm(chord)) || span == 0.)
        throw UserError("the ends are not apart across the load: give the unstressed length");
      return span;
    }
  } // namespace

  double length_for_tension(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                            const Coordinates &force, const double tension)
  {
    const double span = span_of(from, to, force),
                 depth = norm(force) * span * span / (8. * tension);
    const Coordinates chord = to - from;
    if (norm(force) == 0.) // a straight line
      return length_of_parabola(make(span), chord, force, 0., tension);
    return find_length(
        [&](const double length)
        {
          const CableElements cable = make(length);
          // A compressed cable counts as less than any tension.
          const double H = horizontal_tension(cable, hang(cable, from, to, force), force);
          return std::log(std::max(H / tension, 1e-300));
        },
        length_of_parabola(make(norm(chord)), chord, force, depth, tension), "horizontal tension");
  }

  double length_for_sag(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                        const Coordinates &force, const double depth)
  {
    const double span = span_of(from, to, force),
                 tension = norm(force) * span * span / (8. * depth);
    const Coordinates chord = to - from;
    return find_length(
        [&](const double length)
        {
          const CableElements cable = make(length);
          return sag(cable, hang(cable, from, to, force), force) / depth - 1.;
        },
        length_of_parabola(make(norm(chord)), chord, force, depth, tension), "sag");
  }

  double length_through(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                        const Coordinates &force, const Coordinates &place)
  {
    const double span = span_of(from, to, force);
    const Coordinates chord = to - from, down = unit_or_zero(force),
                      across = unit_or_zero(add_scaled(chord, -dot(chord, down), down)),
                      way = place - from;
    const double t = dot(way, across) / span;
    const Coordinates below = add_scaled(way, -t, chord);
    const double depth = dot(below, down), beside = norm(add_scaled(below, -depth, down)),
                 size = norm(chord) + norm(way);
    if (norm(force) == 0.)
      throw UserError("without weight or wind the cable is a straight line; give the unstressed "
                      "length");
    if (beside > 1e-9 * size)
      throw UserError(
          "the cable hangs in the plane of its ends, weight and wind, and the place is " +
          to_text(beside) + " m beside it; take a place in that plane");
    if (!(t > 0. && t < 1.))
      throw UserError("the place is not between the ends of the cable, as seen along weight and "
                      "wind; take one that is");
    if (!(depth > 1e-12 * size))
      throw UserError("the place is " + to_text(-depth) +
                      " m above the straight line between the ends of the cable, which hangs below "
                      "it; take a lower place");
    const double of_middle = depth / (4. * t * (1. - t)),
                 tension = norm(force) * span * span / (8. * of_middle);
    return find_length(
        [&](const double length)
        {
          const CableElements cable = make(length);
          return depth_at(cable, hang(cable, from, to, force), force, t) / depth - 1.;
        },
        length_of_parabola(make(norm(chord)), chord, force, of_middle, tension),
        "place that the cable passes through");
  }
} // namespace taut
