// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mortar_rows.h"
#include "surface_geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  namespace
  {
    /// Rows that differ by less in all weights become one.
    constexpr double merge_limit = .1;

    /// Weights below this part of the largest are rounding.
    constexpr double rounding = 1e-14;

    /// Largest vector of s a - t b.
    double largest_difference(const NodeVectors &a, const double s, const NodeVectors &b,
                              const double t)
    {
      NodeVectors difference;
      for (const NodeWeight &entry : a.entries())
        difference.add(entry.node, s, entry.weight);
      for (const NodeWeight &entry : b.entries())
        difference.add(entry.node, -t, entry.weight);
      double largest = 0.;
      for (const NodeWeight &entry : difference.entries())
        largest = std::max(largest, norm(entry.weight));
      return largest;
    }

    double difference(const MortarRow &a, const MortarRow &b)
    {
      return std::max(largest_difference(a.slave, 1. / a.area, b.slave, 1. / b.area),
                      largest_difference(a.master, 1. / a.area, b.master, 1. / b.area));
    }

    /// Weights of a mean. Those that are rounding go to the largest, so that their sum stays.
    std::vector<NodeWeight> weights(const NodeVectors &integrals, const double area)
    {
      double largest = 0.;
      for (const NodeWeight &entry : integrals.entries())
        largest = std::max(largest, norm(entry.weight));
      std::vector<NodeWeight> result;
      Coordinates rest;
      std::size_t where = 0;
      for (const NodeWeight &entry : integrals.entries())
        if (norm(entry.weight) > rounding * largest)
        {
          if (norm(entry.weight) == largest)
            where = result.size();
          result.push_back({entry.node, scaled(1. / area, entry.weight)});
        }
        else
          rest = add_scaled(rest, 1. / area, entry.weight);
      result[where].weight = add_scaled(result[where].weight, 1., rest);
      return result;
    }
  } // namespace

  void NodeVectors::add(const unsigned int node, const double factor, const Coordinates &vector)
  {
    auto it = std::lower_bound(sorted.begin(), sorted.end(), node,
                               [](const NodeWeight &w, const unsigned int n)
                               { return w.node < n; });
    if (it == sorted.end() || it->node != node)
      it = sorted.insert(it, {node, {}});
    it->weight = add_scaled(it->weight, factor, vector);
  }

  void NodeVectors::add(const NodeVectors &other)
  {
    for (const NodeWeight &entry : other.sorted)
      add(entry.node, 1., entry.weight);
  }

  bool MortarRows::merge_closest_pair(const std::vector<unsigned int> &nodes)
  {
    double smallest = merge_limit;
    std::pair<unsigned int, unsigned int> pair;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = i + 1; j < nodes.size(); ++j)
        if (rows[nodes[i]].area > 0. && rows[nodes[j]].area > 0.)
          if (const double d = difference(rows[nodes[i]], rows[nodes[j]]); d < smallest)
          {
            smallest = d;
            pair = {nodes[i], nodes[j]};
          }
    if (smallest == merge_limit)
      return false;
    MortarRow &kept = rows[rows[pair.first].area >= rows[pair.second].area ? pair.first
                                                                          : pair.second];
    MortarRow &gone = &kept == &rows[pair.first] ? rows[pair.second] : rows[pair.first];
    kept.area += gone.area;
    kept.gap += gone.gap;
    kept.point = add_scaled(kept.point, 1., gone.point);
    kept.normal = add_scaled(kept.normal, 1., gone.normal);
    kept.slave.add(gone.slave);
    kept.master.add(gone.master);
    gone = MortarRow();
    return true;
  }

  void MortarRows::merge_slivers()
  {
    bool changed = true;
    while (changed)
    {
      changed = false;
      for (const std::vector<unsigned int> &nodes : slivers)
        changed = merge_closest_pair(nodes) || changed;
    }
  }

  std::vector<SurfaceConstraint> MortarRows::constraints(const double thickness) const
  {
    std::vector<SurfaceConstraint> result;
    for (unsigned int node = 0; node < rows.size(); ++node)
    {
      const MortarRow &row = rows[node];
      if (!(row.area > 0.))
        continue;
      SurfaceConstraint c;
      c.node = node;
      c.area = row.area * thickness;
      c.gap = row.gap / row.area;
      c.point = scaled(1. / row.area, row.point);
      c.normal = normalised(row.normal);
      c.slave = weights(row.slave, row.area);
      c.master = weights(row.master, row.area);
      result.push_back(std::move(c));
    }
    return result;
  }
} // namespace taut
