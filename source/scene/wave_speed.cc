// SPDX-License-Identifier: LGPL-2.1-or-later
#include "wave_speed.h"

#include <taut/base/exceptions.h>
#include <taut/base/text.h>

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
  } // namespace

  bool is_faster_than_waves(const Wire &wire, const double speed)
  {
    return wire.tension > 0. && std::fabs(speed) >= wave_speed(wire);
  }

  void check_speed(const Wire &wire, const double speed, const bool is_allowed,
                   const std::string &section)
  {
    if (is_allowed || !is_faster_than_waves(wire, speed))
      return;
    throw EntryError(section + "/Speed",
                     to_text(std::setprecision(4), std::fabs(speed),
                             " m/s = ", 3.6 * std::fabs(speed),
                             " km/h are not less than the speed of the "
                             "waves of wire '",
                             wire.name, "', ", wave_speed(wire), " m/s from its tension of ",
                             wire.tension, " N and its mass of ", wire.mass_per_length,
                             " kg/m, so that what is ahead does not know of it. Slow it down, or "
                             "set 'Faster than waves = true' if that is meant"));
  }
} // namespace taut
