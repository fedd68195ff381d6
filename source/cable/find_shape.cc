// SPDX-License-Identifier: LGPL-2.1-or-later

#include "base/text.h"
#include "cable/cable_equilibrium.h"
#include "cable/parabola.h"
#include <taut/base/exceptions.h>
#include <taut/cable/find_shape.h>
#include <taut/substructure/body_traits.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <string>

namespace taut
{
  namespace
  {
    /// Rounding of the length of a cable that is as long as the distance of its ends, over the
    /// length.
    constexpr double exactly_taut = 1e-12;

  } // namespace

  CableShape find_shape(const CableElements &cable, const std::vector<double> &start,
                        const std::vector<unsigned int> &held, const std::vector<double> &load,
                        const double tension)
  {
    CableEquilibrium search(cable, held, load);
    CableShape result;
    result.positions = start;
    const double EA = cable.section().axial_stiffness;
    // A stage that fails is left out: the next stage may succeed.
    for (const double stiffness : SlenderBody::softer_axial_stiffnesses(EA, tension))
      search.find_roughly(cable.with_axial_stiffness(stiffness), result.positions);
    if (search.find(cable, result.positions))
    {
      result.n_iterations = search.iterations();
      result.residual = search.residual();
      return result;
    }
    if (!std::isfinite(search.residual()))
      throw UserError("its length, stiffness or load is beyond the range of numbers; take less "
                      "extreme values");
    throw UserError("no stable equilibrium of the cable was found: after " +
                    std::to_string(search.iterations()) + " iterations a force of " +
                    to_text(search.residual()) +
                    (search.is_balanced() ? " N is not balanced, which is good enough, but the "
                                            "least push would move the cable away"
                                          : " N is not balanced") +
                    "; take more elements, a little bending stiffness, or ends that are further "
                    "apart across the load");
  }

  CableShape hang(const CableElements &cable, const Coordinates &from, const Coordinates &to,
                  const Coordinates &force)
  {
    std::vector<unsigned int> held;
    for (const bool last : {false, true})
      for (const unsigned int i : cable.end_dofs(last))
        held.push_back(i);
    std::vector<double> load(cable.n_dofs(), 0.);
    cable.add_load(force, load);

    const Coordinates chord = to - from, down = unit_or_zero(force);
    const double distance = norm(chord), length = cable.length(), w = norm(force),
                 span = norm(add_scaled(chord, -dot(chord, down), down));
    // Tension of a line without slack that sags by its own elongation.
    const double EA = cable.section().axial_stiffness,
                 of_stretch = std::cbrt(EA * std::pow(w * span, 2) / 24.);
    if (EA * (distance / length - 1.) > of_stretch)
      return find_shape(cable, Parabola{chord, down, 0.}.positions(cable, from), held, load);
    if (w == 0. && std::fabs(distance - length) <= exactly_taut * length)
      return {Parabola{chord, down, 0.}.positions(cable, from)};
    if (w == 0.)
      throw UserError("a cable of " + to_text(length) + " m between ends " + to_text(distance) +
                      " m apart has no shape of its own without weight or wind; make it shorter or "
                      "give it a load");
    const double of_slack = w * span * span / (8. * parabola(chord, down, length).depth);
    if (of_stretch < of_slack)
      return find_shape(
          cable, parabola(chord, down, length * (1. + of_stretch / EA)).positions(cable, from),
          held, load);
    if (span <= above_each_other * distance)
      throw UserError(
          "no stable equilibrium of the cable: along weight and wind its ends are above "
          "each other, and it is slack between them, with no plane to hang in. Move "
          "one of them to the side, or let Held ends leave the lower one free");
    // Stretched by its tension: without any, nothing would hold the first step.
    const double tension = .5 * w * length + of_slack;
    const std::vector<double> softer = SlenderBody::softer_axial_stiffnesses(EA, tension);
    const double stretched = length * (1. + tension / (softer.empty() ? EA : softer.front()));
    return find_shape(cable, parabola(chord, down, stretched).positions(cable, from), held, load,
                      tension);
  }

  double hanging_length(const CableElements &cable, const Coordinates &force)
  {
    const double length = cable.length();
    return length + .5 * norm(force) * length * length / cable.section().axial_stiffness;
  }

  CableShape hang_freely(const CableElements &cable, const Coordinates &held, const bool from_last,
                         const Coordinates &force)
  {
    const double length = cable.length(),
                 strain = norm(force) * length / cable.section().axial_stiffness;
    const Coordinates down = unit_or_zero(force);
    // Distance from the held end, and its derivative with respect to s.
    const auto way = [&](const double s)
    {
      const double x = from_last ? length - s : s;
      return x + strain * x * (1. - .5 * x / length);
    };
    const auto slope = [&](const double s)
    {
      const double x = from_last ? length - s : s;
      return (from_last ? -1. : 1.) * (1. + strain * (1. - x / length));
    };
    CableShape result;
    result.positions =
        cable.interpolate([&](const double s) { return add_scaled(held, way(s), down); },
                          [&](const double s) { return add_scaled({}, slope(s), down); });
    return result;
  }

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
