// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/check_parts.h"

#include "scene/travel.h"
#include "scene/wave_speed.h"

#include <cmath>

namespace taut
{
  double wave_speed(const Wire &wire)
  {
    constexpr double highest = 2. * 3.14159265358979323846 * 20.; // of judged forces [rad/s]
    // A part of the tension that changes the speed by no more than droppers and clamps do.
    constexpr double small_part = .05;
    const double T = wire.tension, EI = wire.bending_stiffness, m = wire.mass_per_length;
    // EI q^2, with EI q^4 + T q^2 = m omega^2
    const double of_bending = .5 * (std::sqrt(T * T + 4. * EI * m * highest * highest) - T);
    const double stiffening = wire.foundation_stiffness > 0.
                                  ? 2. * std::sqrt(wire.foundation_stiffness * EI)
                              : of_bending > small_part * T ? of_bending
                                                            : 0.;
    return std::sqrt((T + stiffening) / m);
  }

  namespace
  {
    template <typename Item>
    void check_item(const Scene &scene, const Item &item, const Attachment &runs_on,
                    const double end_time)
    {
      if (item.faster_than_waves || runs_on.kind != Attachment::Kind::wire)
        return;
      const Wire &wire = scene.wires[runs_on.index];
      const double fastest = travel_range(item, end_time).fastest;
      if (!(wire.tension > 0. && fastest >= wave_speed(wire)))
        return;
      throw EntryError(item.origin.empty() ? "" : item.origin + "/Speed",
                       to_text(std::setprecision(4), fastest, " m/s = ", 3.6 * fastest,
                               " km/h are not less than the speed of the waves of wire '",
                               wire.name, "', ", wave_speed(wire), " m/s from its tension of ",
                               wire.tension, " N, its bending stiffness of ",
                               wire.bending_stiffness, " N m^2 and its mass of ",
                               wire.mass_per_length,
                               " kg/m, so that what is ahead does not know of it. Slow it down, or "
                               "set 'Faster than waves = true' if that is meant"));
    }
  } // namespace

  void check_wave_speed(const Scene &scene, const Link &link, const double end_time)
  {
    check_item(scene, link, link.to, end_time);
  }

  void check_wave_speed(const Scene &scene, const Load &load, const double end_time)
  {
    check_item(scene, load, load.target, end_time);
  }
} // namespace taut
