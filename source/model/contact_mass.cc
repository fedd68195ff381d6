// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/contact_mass.h"
#include "model/scene_constraints.h"
#include "time/contact_resolution.h"
#include <taut/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace taut
{
  /// Courant numbers: the number of elements that waves cross in a step [s], at the ends of links
  /// on wires.
  class CourantNumbers
  {
  public:
    /// @p scene is kept by reference.
    CourantNumbers(const Scene &scene, double step);

    /// Elements that the fastest waves of the motion of a link cross in a step, from an end on a
    /// wire: wave speed times step over the shortest adjacent element [1].
    double at(const Link &link, const Attachment &end) const;

    /// Index in grid(scene, wire) of the node nearest to an attachment on a wire.
    std::size_t node(const Attachment &end) const;

    /// Elements of a wire.
    std::size_t n_elements(std::size_t wire) const { return grids[wire].size() - 1; }

  private:
    const Scene &scene;
    const double step;
    std::vector<std::vector<double>> grids; ///< of each wire
  };

  /// True if a motion of the wire along the direction is across it, and bends it.
  bool bends(const Wire &wire, const Coordinates &direction);

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

  namespace
  {
    /// Largest number of elements that a wave crosses in a step, for which the elements of a node
    /// without mass are a spring on which no scheme rings (measured on the bar that hits a wall,
    /// doc/accuracy.md).
    constexpr double most_courant_number = 4. * (1. + 1e-6);

    bool is_on_wire(const Link &link)
    {
      return link.from.kind == Attachment::Kind::wire || link.to.kind == Attachment::Kind::wire;
    }

    /// The exactly rigid unilateral links, if nodes without mass suit all of them: stops on bars or
    /// strings, two elements apart, whose waves are slow enough; otherwise none.
    std::vector<std::size_t> find_springy_stops(const Scene &scene, const double step)
    {
      const CourantNumbers courant(scene, step);
      std::vector<std::size_t> stops;
      std::vector<std::pair<std::size_t, std::size_t>> nodes; // wire and node
      for (std::size_t i = 0; i < scene.links.size(); ++i)
      {
        const Link &link = scene.links[i];
        if (!link.unilateral() || !link.rigid() || link.form.axial_stiffness != 0.)
          continue;
        if (link.kind != LinkKind::stop || link.turns || !is_on_wire(link))
          return {};
        for (const Attachment *end : {&link.from, &link.to})
        {
          if (end->kind != Attachment::Kind::wire)
            continue;
          if (link.rotational || bends(scene.wires[end->index], link.direction) ||
              !(courant.at(link, *end) <= most_courant_number) ||
              courant.n_elements(end->index) < 2)
            return {};
          nodes.emplace_back(end->index, courant.node(*end));
        }
        stops.push_back(i);
      }
      std::sort(nodes.begin(), nodes.end());
      const bool are_close =
          std::adjacent_find(nodes.begin(), nodes.end(),
                             [](const auto &a, const auto &b) {
                               return a.first == b.first && b.second - a.second < 2;
                             }) != nodes.end();
      return are_close ? std::vector<std::size_t>() : stops;
    }
  } // namespace

  bool is_massless(const Link &link)
  {
    return link.contact_mass != ContactMass::stays && is_on_wire(link);
  }

  void redistribute_contact_mass(Scene &scene, const SolverParameters &parameters,
                                 const double step)
  {
    const std::vector<std::size_t> stops = find_springy_stops(scene, step);
    if (stops.empty())
      return;
    Scene lighter = scene;
    for (const std::size_t i : stops)
      lighter.links[i].contact_mass = ContactMass::keeps_total;
    // Links with a stiffness may act as rigid, too, and so may a node to which a mass is joined:
    // this depends on the bodies.
    const SceneBodies structure(lighter);
    const Constraints constraints = scene_constraints(lighter, structure);
    const ContactResolution resolution(structure, constraints, parameters, step, step, 0.);
    if (resolution.first_rigid() != no_link)
      return;
    scene = std::move(lighter);
  }
} // namespace taut
