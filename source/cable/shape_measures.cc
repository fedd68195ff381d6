// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/parabola.h"

#include <taut/cable/find_shape.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// A shape seen in the plane of chord and load.
    class Profile
    {
    public:
      Profile(const CableElements &cable, const CableShape &shape, const Coordinates &force)
          : cable(cable), q(shape.positions), from(cable.position(q, 0.)),
            chord(cable.position(q, cable.length()) - from), down(unit_or_zero(force)),
            across(add_scaled(chord, -dot(chord, down), down)), span_squared(dot(across, across))
      {
      }

      /// 0 at the first end, 1 at the last one; 0 if the ends are not apart across the load.
      double part_of_span(const double s) const
      {
        return span_squared == 0. ? 0. : dot(cable.position(q, s) - from, across) / span_squared;
      }

      /// Below the chord, along the load [m].
      double depth(const double s) const
      {
        const Coordinates r = cable.position(q, s) - from;
        return dot(add_scaled(r, -part_of_span(s), chord), down);
      }

    private:
      const CableElements &cable;
      const std::vector<double> &q;
      const Coordinates from, chord, down, across;
      const double span_squared;
    };
  } // namespace

  double horizontal_tension(const CableElements &cable, const CableShape &shape,
                            const Coordinates &force)
  {
    const std::vector<double> &q = shape.positions;
    const Coordinates chord = cable.position(q, cable.length()) - cable.position(q, 0.),
                      down = unit_or_zero(force),
                      across = unit_or_zero(add_scaled(chord, -dot(chord, down), down));
    std::vector<double> f;
    cable.internal_force(q, {}, f);
    return -cable.position(0., across).dot(f);
  }

  double sag(const CableElements &cable, const CableShape &shape, const Coordinates &force)
  {
    const Profile profile(cable, shape, force);
    const auto height = [&](const double s) { return -profile.depth(s); };
    unsigned int lowest = 0;
    for (unsigned int i = 1; i <= cable.n_elements(); ++i)
      if (height(cable.place(i)) < height(cable.place(lowest)))
        lowest = i;
    return -boost::math::tools::brent_find_minima(
                height, cable.place(std::max(0., lowest - 1.)),
                cable.place(std::min<double>(cable.n_elements(), lowest + 1.)), 40)
                .second;
  }

  double depth_at(const CableElements &cable, const CableShape &shape, const Coordinates &force,
                  const double part_of_span)
  {
    const Profile profile(cable, shape, force);
    double low = 0., high = cable.length();
    while (true)
    {
      const double s = .5 * (low + high);
      if (s <= low || s >= high)
        return profile.depth(s);
      (profile.part_of_span(s) < part_of_span ? low : high) = s;
    }
  }
} // namespace taut
