// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/mortar_rows.h"
#include "solid/surface_geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  namespace
  {
    /// Rows of a sliver become one row if they differ by less than this in all weights.
    constexpr double small_difference = .1;

    /// On a sliver, nodes with areas below this part of the largest area have no row of their own.
    constexpr double small_area = .1;

    /// Weights below this part of the largest weight are rounding.
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

    /// Weights of a mean. Weights that are rounding are added to the largest weight, so that the
    /// sum is kept.
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
    auto it =
        std::lower_bound(sorted.begin(), sorted.end(), node,
                         [](const NodeWeight &w, const unsigned int n) { return w.node < n; });
    if (it == sorted.end() || it->node != node)
      it = sorted.insert(it, {node, {}});
    it->weight = add_scaled(it->weight, factor, vector);
  }

  void NodeVectors::add(const NodeVectors &other)
  {
    for (const NodeWeight &entry : other.sorted)
      add(entry.node, 1., entry.weight);
  }

  void MortarRows::merge(const unsigned int gone, const unsigned int kept)
  {
    MortarRow &from = rows[gone], &to = rows[kept];
    to.area += from.area;
    to.gap += from.gap;
    to.uncovered = std::max(to.uncovered, from.uncovered);
    to.point = add_scaled(to.point, 1., from.point);
    to.normal = add_scaled(to.normal, 1., from.normal);
    to.slave.add(from.slave);
    to.master.add(from.master);
    from = MortarRow();
  }

  bool MortarRows::merge_small(const std::vector<unsigned int> &nodes)
  {
    const auto is_smaller = [this](const unsigned int a, const unsigned int b)
    { return rows[a].area < rows[b].area; };
    const unsigned int largest = *std::max_element(nodes.begin(), nodes.end(), is_smaller),
                       smallest = *std::min_element(nodes.begin(), nodes.end(), is_smaller);
    if (rows[smallest].area >= small_area * rows[largest].area)
      return false;
    for (const unsigned int node : nodes)
      if (node != largest)
        merge(node, largest);
    return true;
  }

  bool MortarRows::merge_closest_pair(const std::vector<unsigned int> &nodes)
  {
    double smallest = small_difference;
    std::pair<unsigned int, unsigned int> pair;
    for (const unsigned int a : nodes)
      for (const unsigned int b : nodes)
        if (a < b)
          if (const double d = difference(rows[a], rows[b]); d < smallest)
          {
            smallest = d;
            pair = {a, b};
          }
    if (smallest == small_difference)
      return false;
    const bool first_is_larger = rows[pair.first].area >= rows[pair.second].area;
    merge(first_is_larger ? pair.second : pair.first, first_is_larger ? pair.first : pair.second);
    return true;
  }

  void MortarRows::merge_slivers()
  {
    bool changed = true;
    while (changed)
    {
      changed = false;
      for (std::vector<unsigned int> &nodes : slivers)
      {
        // Rows that an adjacent edge has merged are gone.
        nodes.erase(std::remove_if(nodes.begin(), nodes.end(),
                                   [this](const unsigned int node)
                                   { return !(rows[node].area > 0.); }),
                    nodes.end());
        if (nodes.size() > 1)
          changed = merge_small(nodes) || merge_closest_pair(nodes) || changed;
      }
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
      c.uncovered = row.uncovered;
      c.point = scaled(1. / row.area, row.point);
      c.normal = normalised(row.normal);
      c.slave = weights(row.slave, row.area);
      c.master = weights(row.master, row.area);
      result.push_back(std::move(c));
    }
    return result;
  }
} // namespace taut
