// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/entries.h"

#include <taut/scene/named_items.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  std::string Probe::unit() const
  {
    const std::string length = rotational ? "rad" : "m";
    return length + (quantity == Quantity::velocity       ? "/s"
                     : quantity == Quantity::acceleration ? "/s^2"
                                                          : "");
  }

  void ProbeItem::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Point", point, "A mass or 'wire @ position'", Anything());
    prm.add_parameter("Direction", direction,
                      "'x, y' or 'x, y, z'; the length does not matter. Empty: 0, 1",
                      List(Double(), 0, 3));
    prm.add_parameter("Rotational", rotational, "Slope or rotation instead of displacement");
    prm.add_parameter("Quantity", quantity,
                      "What is recorded: displacements from rest [m, rad], or velocities [m/s, "
                      "rad/s] or accelerations [m/s^2, rad/s^2] as the scheme has them at the ends "
                      "of steps",
                      Selection("displacement|velocity|acceleration"));
    prm.add_parameter("Axis", axis,
                      "Of a rotation, 'x, y, z'; the length does not matter. Empty: z",
                      List(Double(), 0, 3));
  }

  void ProbeItem::add(const std::string &name, const std::string &title, Scene &scene) const
  {
    const std::vector<Attachment> points = parse_attachments(point, scene, title + "/Point");
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      Probe probe;
      probe.name = name + (points.size() > 1 ? " " + std::to_string(k + 1) : "");
      probe.origin = title;
      probe.point = points[k];
      probe.rotational = rotational;
      probe.quantity = quantity == "velocity"       ? Probe::Quantity::velocity
                       : quantity == "acceleration" ? Probe::Quantity::acceleration
                                                    : Probe::Quantity::displacement;
      probe.direction = parse_direction_or_axis(rotational, direction, axis, title);
      scene.probes.push_back(probe);
    }
  }
} // namespace taut
