// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wave_speed.h"

#include "check_parts.h"

#include <taut/scene/travel.h>

#include <cmath>

namespace taut
{
  namespace
  {
    double wave_speed(const Wire &wire)
    {
      return std::sqrt(
          (wire.tension + 2. * std::sqrt(wire.foundation_stiffness * wire.bending_stiffness)) /
          wire.mass_per_length);
    }

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
                               wire.tension, " N and its mass of ", wire.mass_per_length,
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
