// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/courant_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    bool has_part(const Coordinates &direction, const Coordinates &along)
    {
      return std::fabs(dot(direction, along)) > 1e-12;
    }

    /// Speed of the shortest waves that elements of a length carry across a wire, squared.
    double transverse_speed_squared(const Wire &wire, const double element)
    {
      const double wave_number = std::acos(-1.) / element;
      return (wire.tension + wire.bending_stiffness * wave_number * wave_number) /
             wire.mass_per_length;
    }
  } // namespace

  bool bends(const Wire &wire, const Coordinates &direction)
  {
    return wire.transverse == TransverseKind::beam &&
           (has_part(direction, wire.normal()) ||
            (wire.has_lateral && has_part(direction, wire.binormal())));
  }

  CourantNumbers::CourantNumbers(const Scene &scene, const double step) : scene(scene), step(step)
  {
    for (std::size_t i = 0; i < scene.wires.size(); ++i)
      grids.push_back(grid(scene, i));
  }

  std::size_t CourantNumbers::node(const Attachment &end) const
  {
    const std::vector<double> &nodes = grids[end.index];
    const auto next = std::lower_bound(nodes.begin() + 1, nodes.end() - 1, end.position);
    const bool is_nearer = *next - end.position < end.position - *(next - 1);
    return static_cast<std::size_t>(next - nodes.begin()) - (is_nearer ? 0 : 1);
  }

  double CourantNumbers::at(const Link &link, const Attachment &end) const
  {
    const Wire &wire = scene.wires[end.index];
    const std::vector<double> &nodes = grids[end.index];
    const std::size_t middle = node(end), first = middle > 0 ? middle - 1 : middle,
                      last = std::min(middle + 1, n_elements(end.index));
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < last; ++i)
      shortest = std::min(shortest, nodes[i + 1] - nodes[i]);
    double speed_squared = 0.;
    if (wire.has_axial && has_part(link.direction, wire.tangent()))
      speed_squared = wire.axial_stiffness / wire.mass_per_length;
    if ((wire.has(WireMotion::transverse) && has_part(link.direction, wire.normal())) ||
        (wire.has(WireMotion::lateral) && has_part(link.direction, wire.binormal())))
      speed_squared = std::max(speed_squared, transverse_speed_squared(wire, shortest));
    return std::sqrt(speed_squared) * step / shortest;
  }
} // namespace taut
