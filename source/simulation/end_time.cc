// SPDX-License-Identifier: LGPL-2.1-or-later
// The entry Time/End: a time, or a place that the first sliding contact comes to.
#include "base/text.h"
#include "scene/travel.h"
#include <taut/simulation/parameters.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>

namespace taut
{
  namespace
  {
    const std::string entry = "Time/End";

    /// Time at which a contact comes to an x [s]. Throws EntryError if it never does.
    double time_at(const Scene &scene, const Link &contact, const double x)
    {
      constexpr double least_part_along_x = 1e-3, latest = 1e5;
      const std::string name = "sliding contact '" + contact.name + "'";
      if (contact.to.kind != Attachment::Kind::wire)
        throw EntryError(entry, name + " is not on a wire, and where it is depends on the motion; "
                                       "write a time");
      const Wire &wire = scene.wires[contact.to.index];
      const double along_x = wire.tangent().x;
      if (std::fabs(along_x) < least_part_along_x)
        throw EntryError(entry, name + " slides along wire '" + wire.name +
                                    "', which is across x; write a time");
      const double way = (x - wire.a.x) / along_x - contact.to.position,
                   start = wire.a.x + contact.to.position * along_x;
      if (way == 0.)
        throw EntryError(entry, name + to_text(" stands at x = ", x,
                                               " m from the beginning; name another place"));
      const double time = time_of_way({contact.speed, contact.travel}, way, latest);
      if (!std::isfinite(time))
        throw EntryError(entry, name + to_text(" never comes to x = ", x, " m: it begins at x = ",
                                               start, " m, with ", speed_at(contact, 0.) * along_x,
                                               " m/s along x. Name a place on its way, or write a "
                                               "time"));
      return time;
    }
  } // namespace

  /// Time/End [s]. Throws EntryError.
  double Parameters::find_end_time() const
  {
    char *last = nullptr;
    const double time = std::strtod(end.c_str(), &last);
    if (last != end.c_str() && trim(last).empty())
    {
      if (!(time >= 0.) || !std::isfinite(time))
        throw EntryError(entry, "it must be a finite number that is not negative");
      return time;
    }
    static const std::regex place("until\\s+x\\s*=\\s*(\\S+?)\\s*m?");
    std::smatch match;
    double x = NAN;
    if (std::regex_match(end, match, place))
    {
      const std::string number = match[1];
      x = std::strtod(number.c_str(), &last);
      x = *last == '\0' ? x : NAN;
    }
    if (!std::isfinite(x))
      throw EntryError(entry, "'" + end +
                                  "' is no end; write a time in seconds, or "
                                  "'until x = 540 m'");
    const Scene scene = generated_scene();
    const auto contact = std::find_if(scene.links.begin(), scene.links.end(),
                                      [](const Link &link) { return link.moving(); });
    if (contact == scene.links.end())
      throw EntryError(entry, "nothing slides in this scene that could come to a place; write a "
                              "time");
    return time_at(scene, *contact, x);
  }
} // namespace taut
