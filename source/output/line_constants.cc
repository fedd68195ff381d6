// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/line_constants.h>
#include <taut/scene/travel.h>
#include <taut/scene/wave_speed.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Resistance of a wire to waves, sqrt(T m) [N s/m].
    double impedance(const Wire &wire)
    {
      return std::sqrt(wire.tension * wire.mass_per_length);
    }
  } // namespace

  std::vector<LineConstants> line_constants(const Scene &scene)
  {
    std::vector<LineConstants> result;
    for (const Link &link : scene.links)
    {
      if (!link.moving() || link.to.kind != Attachment::Kind::wire)
        continue;
      const Wire &wire = scene.wires[link.to.index];
      if (!(wire.tension > 0. && wire.mass_per_length > 0.))
        continue;
      LineConstants found{link.name, wire.name};
      found.speed = std::fabs(link.speed);
      if (link.travel)
        found.speed = std::max(std::fabs(link.travel->speed(0.)), link.travel->range().fastest);
      const double c = found.wave_speed = wave_speed(wire);
      found.doppler = std::max(0., (c - found.speed) / (c + found.speed));
      const auto holds = [&](const Link &dropper)
      {
        return dropper.kind == LinkKind::dropper && dropper.to.kind == Attachment::Kind::wire &&
               dropper.from.kind == Attachment::Kind::wire && dropper.to.index == link.to.index;
      };
      const auto dropper = std::find_if(scene.links.begin(), scene.links.end(), holds);
      if (dropper != scene.links.end())
      {
        const double above = impedance(scene.wires[dropper->from.index]);
        found.reflection = above / (above + impedance(wire));
        found.amplification = found.doppler > 0. ? found.reflection / found.doppler : 0.;
      }
      result.push_back(found);
    }
    return result;
  }
} // namespace taut
