// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/kinks.h"
#include "scene/check_parts.h"

#include "base/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace taut
{
  namespace
  {
    /// Rounding of a unit vector, and of a tension over its size.
    constexpr double rounding = 1e-9;

    /// Largest distance of a place from the end of a wire, over the length of the wire, and in [m]:
    /// places are written with few digits.
    constexpr double near_end = 1e-3, nearest = 1e-3;

    using End =
        std::pair<std::size_t, bool>; ///< number of the wire, and whether it is the last end

    /// Whether a place is an end of a wire under tension.
    bool find_end(const Scene &scene, const Attachment &at, End &end)
    {
      if (at.kind != Attachment::Kind::wire)
        return false;
      const Wire &wire = scene.wires[at.index];
      if (!(wire.tension > 0.) || (wire.transverse == TransverseKind::none && !wire.has_lateral))
        return false;
      const double length = wire.length();
      end = {at.index, at.position > .5 * length};
      return std::fabs(at.position - (end.second ? length : 0.)) <=
             std::min(near_end * length, nearest);
    }

    Coordinates pull(const Scene &scene, const End &end)
    {
      const Wire &wire = scene.wires[end.first];
      return add_scaled({}, end.second ? -wire.tension : wire.tension, wire.tangent());
    }

    /// The part of a unit vector orthogonal to all others, scaled to length 1; false if there is
    /// none.
    bool across(const std::vector<Coordinates> &others, Coordinates &direction)
    {
      for (const Coordinates &other : others)
        direction = add_scaled(direction, -dot(direction, other), other);
      const double size = norm(direction);
      if (size <= rounding)
        return false;
      direction = add_scaled({}, 1. / size, direction);
      return true;
    }

    Load make_load(const Link &link, const Attachment &target, const Coordinates &direction,
                   const double magnitude)
    {
      Load load;
      load.name = "pull at " + link.name;
      load.origin = link.origin;
      load.target = target;
      load.direction = direction;
      load.magnitude = Expression(to_text(std::setprecision(17), magnitude), link.origin,
                                  Expression::Variables::time);
      return load;
    }
  } // namespace

  void add_pulls_of_kinks(Scene &scene)
  {
    std::map<End, std::vector<Coordinates>> held; // orthogonal directions in which an end pulls
    for (const Link &link : scene.links)
    {
      std::array<End, 2> ends;
      if (link.kind != LinkKind::joint || link.rotational || link.turns || !link.rigid() ||
          !find_end(scene, link.from, ends[0]) || !find_end(scene, link.to, ends[1]))
        continue;
      struct Pull
      {
        Attachment own, other;
        Coordinates direction, force;
      };
      std::vector<Pull> pulls;
      double size = 0.;
      for (const bool last : {false, true})
      {
        const End &end = ends[last];
        Coordinates direction = link.direction;
        if (!across(held[end], direction))
          continue;
        held[end].push_back(direction);
        const Coordinates force = pull(scene, end);
        size += norm(force);
        pulls.push_back({last ? link.to : link.from, last ? link.from : link.to, direction,
                         add_scaled({}, dot(force, direction), direction)});
      }
      // Along a common direction both ends move alike, and the sum of their pulls counts.
      if (pulls.size() == 2 && norm(pulls[0].direction - pulls[1].direction) <= rounding)
      {
        pulls[1].force = add_scaled(pulls[0].force, 1., pulls[1].force);
        pulls.erase(pulls.begin());
      }
      for (const Pull &pulled : pulls)
      {
        const double magnitude = norm(pulled.force);
        if (magnitude <= rounding * size)
          continue;
        const Coordinates direction = add_scaled({}, 1. / magnitude, pulled.force);
        for (const Attachment &at : {pulled.own, pulled.other})
          if (can_move(scene, at, false, direction))
          {
            scene.loads.push_back(make_load(link, at, direction, magnitude));
            break;
          }
      }
    }
  }
} // namespace taut
