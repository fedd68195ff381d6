// SPDX-License-Identifier: LGPL-2.1-or-later
// What is compared of two runs of one scene, and how; see observation.h.
#include "observation.h"

namespace extremes
{
  namespace
  {
    bool alike(const taut::Attachment &a, const taut::Attachment &b)
    {
      return a.kind == b.kind && (a.kind == taut::Attachment::Kind::ground ||
                                  (a.index == b.index && a.position == b.position));
    }

    const char *const names[n_quantities] = {"displacement", "rotation", "force",
                                             "moment",       "gap",      "angular gap"};
  } // namespace

  std::vector<ObservedPoint> observed_points(const taut::Scene &scene)
  {
    using Kind = taut::Attachment::Kind;
    std::vector<ObservedPoint> points;
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      const taut::Wire &wire = scene.wires[w];
      const std::vector<double> nodes = grid(scene, w);
      const std::size_t n = std::min<std::size_t>(9, nodes.size());
      for (std::size_t i = 0; i < n; ++i)
      {
        const taut::Attachment at = {Kind::wire, w, nodes[i * (nodes.size() - 1) / (n - 1)]};
        if (wire.has_axial)
          points.push_back({at, false, wire.tangent()});
        if (wire.transverse != taut::TransverseKind::none)
          points.push_back({at, false, wire.normal()});
        if (wire.transverse == taut::TransverseKind::beam)
          points.push_back({at, true, wire.binormal()});
      }
    }
    for (std::size_t m = 0; m < scene.masses.size(); ++m)
      for (int motion = 0; motion < 3; ++motion)
        if (scene.masses[m].moves[motion])
          points.push_back({{Kind::mass, m, 0.},
                            motion == 2,
                            motion == 0   ? taut::Coordinates{1., 0.}
                            : motion == 1 ? taut::Coordinates{0., 1.}
                                          : taut::Coordinates{0., 0., 1.}});
    return points;
  }

  std::vector<std::size_t> groups_of_links(const taut::Scene &scene)
  {
    std::vector<std::size_t> group(scene.links.size());
    for (std::size_t i = 0; i < group.size(); ++i)
    {
      group[i] = i;
      for (std::size_t j = 0; j < i && group[i] == i; ++j)
      {
        const taut::Link &a = scene.links[i], &b = scene.links[j];
        const bool same_sign =
            (a.kind == taut::LinkKind::dropper) == (b.kind == taut::LinkKind::dropper);
        if (alike(a.from, b.from) && alike(a.to, b.to) && a.rotational == b.rotational &&
            same_sign && a.direction == b.direction && a.moving() == b.moving() &&
            a.speed == b.speed)
          group[i] = j;
      }
    }
    return group;
  }

  std::array<double, n_quantities> scales(const Case &c, const Answer &answer)
  {
    std::array<double, n_quantities> result = {};
    result[force] = answer.elastic_force;
    result[moment] = answer.elastic_moment;
    for (const Observation &o : answer.steps)
      for (int q = 0; q < n_quantities; ++q)
        for (const double x : o[q])
          result[q] = std::max(result[q], std::fabs(x));
    for (const taut::Load &load : c.scene.loads)
    {
      double &scale = result[load.rotational ? moment : force];
      scale = std::max(scale, std::fabs(load.magnitude(0., 0.)));
    }
    result[gap] = std::max({result[gap], result[displacement], answer.row_motion});
    result[angular_gap] = std::max({result[angular_gap], result[rotation], answer.row_turn});
    return result;
  }

  Deviation compare(const std::vector<Observation> &a, const std::vector<Observation> &b,
                    const std::array<double, n_quantities> &scales,
                    const std::vector<std::vector<Observation>> &neighbours, const double relative,
                    const double absolute)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Deviation result;
    if (a.size() != b.size())
      return {infinity, "number of steps"};
    for (int q = 0; q < n_quantities; ++q)
      for (std::size_t k = 0; k < b.front()[q].size(); ++k)
      {
        double own = 0., sensitivity = 0.;
        for (std::size_t i = 0; i < b.size(); ++i)
        {
          own = std::max(own, std::fabs(b[i][q][k]));
          for (const auto &other : neighbours)
            sensitivity = std::max(sensitivity, std::fabs(other[i][q][k] - b[i][q][k]));
        }
        const double allowed = relative * own + absolute * scales[q] + 1e3 * sensitivity;
        for (std::size_t i = 0; i < b.size(); ++i)
        {
          const double difference = std::fabs(a[i][q][k] - b[i][q][k]);
          if (difference == 0. || difference <= result.excess * allowed)
            continue;
          result.excess = std::isnan(difference) ? infinity : difference / allowed;
          std::ostringstream where;
          where << names[q] << ' ' << k << " of step " << i << ": " << a[i][q][k] << " instead of "
                << b[i][q][k] << ", allowed " << allowed;
          result.where = where.str();
        }
      }
    return result;
  }
} // namespace extremes
