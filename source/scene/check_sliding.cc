// SPDX-License-Identifier: LGPL-2.1-or-later
// Contacts that slide stay on their wires.
#include "scene/check_parts.h"

#include "scene/travel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace taut
{
  namespace
  {
    /// The way of a contact whose speed changes stays on a wire.
    void check_travel(const Link &link, const std::string &what, const double length,
                      const double end_time)
    {
      const TravelRange range = travel_range(link, end_time);
      const double least = link.to.position + range.least,
                   greatest = link.to.position + range.greatest;
      if (least >= -1e-9 * length && greatest <= (1. + 1e-9) * length)
        return;
      const Speed speed{0., link.travel};
      const double last = std::min(time_of_way(speed, -link.to.position, end_time),
                                   time_of_way(speed, length - link.to.position, end_time));
      fail(link, "Speed", what, "it leaves its wire before the end, on a way from ", least, " to ",
           greatest, " m of ", length, " m. Set Time/End to ", last,
           " s at most, or lengthen the wire");
    }
  } // namespace

  void check_sliding(const Scene &scene, const Link &link, const std::string &what,
                     const double end_time)
  {
    if (link.to.kind == Attachment::Kind::body && scene.bodies[link.to.index].type_name == "cable")
      return; // the length of the body is known when the body is made
    if (link.to.kind != Attachment::Kind::wire)
      fail(link, "To", what, "a sliding contact slides on a wire or a cable, 'wire @ start'");
    const Wire &wire = scene.wires[link.to.index];
    if (wire.transverse == TransverseKind::none)
      fail(link, "To", what, "it slides under wire '", wire.name,
           "', which has no transverse motion; give the wire the component string or beam");
    if (!link.strip.empty())
      return; // another wire may be there, see check_strips()
    const double length = wire.length(), end = link.to.position + way(link, end_time);
    if (link.travel)
    {
      check_travel(link, what, length, end_time);
      return;
    }
    if (!(end >= -1e-9 * length && end <= (1. + 1e-9) * length))
    {
      const double last = ((link.speed > 0. ? length : 0.) - link.to.position) / link.speed;
      fail(link, "Speed", what, "it leaves wire '", wire.name,
           "' before the end: at t = ", end_time, " s it would be at ", end, " m of ", length,
           " m. Set Time/End to ", last, " s at most, or lengthen the wire");
    }
  }

  void check_strips(const Scene &scene, const double end_time)
  {
    constexpr double most_apart =
        .01; // over the way, between wires of which one rises by a seventh
    std::map<std::string, std::vector<const Link *>> strips;
    for (const Link &link : scene.links)
      if (link.moving() && !link.strip.empty())
        strips[link.strip].push_back(&link);
    for (const auto &[name, links] : strips)
    {
      // Parts of the way under each wire, from first to last.
      std::vector<std::pair<double, double>> parts;
      const TravelRange range = travel_range(*links.front(), end_time);
      const double end = way(*links.front(), end_time), first = range.least, last = range.greatest,
                   same = 1e-9 * (last - first + 1.);
      const Wire &leader = scene.wires[links.front()->to.index];
      for (const Link *link : links)
      {
        const Wire &wire = scene.wires[link->to.index];
        const double along = dot(wire.tangent(), leader.tangent()),
                     own_end = along * way(*link, end_time);
        if (!(std::fabs(own_end - end) <= most_apart * (last - first) + same))
          fail(*link, "Speed", "strip '", name, "': it moves by ", own_end, " m on wire '",
               wire.name, "' and by ", end, " m on wire '", leader.name,
               "', in the direction of the latter. The speed counts along each wire: give it the "
               "other sign where a wire begins at the other end, or name all wires in one To");
        parts.push_back(
            std::minmax({-along * link->to.position, along * (wire.length() - link->to.position)}));
      }
      std::sort(parts.begin(), parts.end());
      double reached = first;
      for (const auto &[from, to] : parts)
        if (from <= reached + same)
          reached = std::max(reached, to);
      if (!(parts.front().first <= first + same && reached >= last - same))
        fail(*links.front(), "To", "strip '", name, "': no wire is over it ",
             std::max(0., parts.front().first > first + same ? parts.front().first : reached),
             " m from its start, on a way of ", end,
             " m. Lengthen the wires, or end the run earlier");
    }
  }
} // namespace taut
