// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/scene/scene.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  double Wire::length() const
  {
    return norm(b - a);
  }

  Coordinates Wire::tangent() const
  {
    const Coordinates whole = b - a;
    return {whole.x / length(), whole.y / length(), whole.z / length()};
  }

  Coordinates Wire::normal() const
  {
    const Coordinates t = tangent();
    if (t.z == 0.)
      return {-t.y, t.x, 0.};
    const double in_plane = std::hypot(t.x, t.y);
    constexpr double rounding = 1e-12;
    if (in_plane <= rounding)
      return {0., 1., 0.};
    return {-t.y / in_plane, t.x / in_plane, 0.};
  }

  Coordinates Wire::binormal() const
  {
    const Coordinates t = tangent(), n = normal();
    return {-t.z * n.y, t.z * n.x, t.x * n.y - t.y * n.x};
  }

  Coordinates Wire::axis(const WireMotion motion) const
  {
    const WireMotion component = component_of(motion);
    return component == WireMotion::axial        ? tangent()
           : component == WireMotion::transverse ? normal()
                                                 : binormal();
  }

  Coordinates Wire::rotation_axis(const WireMotion motion) const
  {
    const WireMotion component = component_of(motion);
    const Coordinates n = normal();
    return component == WireMotion::transverse
               ? (tangent().z == 0. ? Coordinates{0., 0., 1.} : binormal())
           : component == WireMotion::lateral ? Coordinates{-n.x, -n.y, -n.z}
                                              : Coordinates{};
  }

  bool Wire::has(const WireMotion motion) const
  {
    if (motion == WireMotion::axial)
      return has_axial;
    return (component_of(motion) == WireMotion::transverse || has_lateral) &&
           (is_slope(motion) ? transverse == TransverseKind::beam
                             : transverse != TransverseKind::none);
  }

  unsigned int Wire::n_dofs_per_node() const
  {
    const unsigned int across = transverse == TransverseKind::beam     ? 2
                                : transverse == TransverseKind::string ? degree
                                                                       : 0;
    return (has_axial ? degree : 0) + (has_lateral ? 2 : 1) * across;
  }

  const char *component_name(const WireMotion motion)
  {
    const WireMotion component = component_of(motion);
    return component == WireMotion::axial        ? "axial"
           : component == WireMotion::transverse ? "transverse"
                                                 : "lateral";
  }

  Coordinates Wire::at(const double s) const
  {
    return add_scaled(a, s, tangent());
  }

  std::vector<double> grid(const Scene &scene, const std::size_t wire)
  {
    const double length = scene.wires[wire].length();
    std::vector<double> points = {0., length};
    const auto add = [&](const Attachment &end)
    {
      if (end.kind == Attachment::Kind::wire && end.index == wire)
        points.push_back(end.position);
    };
    for (const TensionChange &change : scene.wires[wire].tension_changes)
      points.insert(points.end(), {change.from, change.to});
    for (const Support &support : scene.supports)
      if (support.wire == wire)
        points.insert(points.end(), support.positions.begin(), support.positions.end());
    for (const PointMass &mass : scene.point_masses)
      if (mass.wire == wire)
        points.insert(points.end(), mass.positions.begin(), mass.positions.end());
    for (const Link &link : scene.links)
    {
      if (link.moving())
        add(link.from);
      else
        Link::visit_places(link, add);
    }
    for (const Load &load : scene.loads)
      if (load.kind == Load::Kind::point)
        add(load.target);

    // Points closer than rounding are one node.
    std::sort(points.begin(), points.end());
    const double same = 1e-12 * length;
    points.erase(std::unique(points.begin(), points.end(),
                             [same](double p, double q) { return q - p <= same; }),
                 points.end());
    points.back() = length;

    std::vector<double> nodes = {0.};
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      const double piece = points[i] - points[i - 1];
      const auto n = static_cast<std::size_t>(
          std::max(1., std::ceil(piece / scene.wires[wire].element_size * (1. - 1e-12))));
      for (std::size_t k = 1; k < n; ++k)
        nodes.push_back(points[i - 1] + piece * k / n);
      nodes.push_back(points[i]);
    }
    return nodes;
  }
} // namespace taut
