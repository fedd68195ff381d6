// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mortar_rows_h
#define taut_mortar_rows_h

#include <taut/scene/contact_surface.h>

#include <vector>

namespace taut
{
  /// Vectors at nodes, ascending.
  class NodeVectors
  {
  public:
    /// Adds factor * vector at a node.
    void add(unsigned int node, double factor, const Coordinates &vector);
    void add(const NodeVectors &other);

    const std::vector<NodeWeight> &entries() const { return sorted; }

  private:
    std::vector<NodeWeight> sorted;
  };

  /// Integrals of a multiplier's basis function psi with gap, normal, places and shape functions.
  struct MortarRow
  {
    double area = 0., gap = 0.; ///< [m], [m^2]
    Coordinates point, normal;
    NodeVectors slave, master;
  };

  /// The rows of the slave's nodes.
  class MortarRows
  {
  public:
    /// Edges of which less than this part is covered, from begin to end, are slivers: only there
    /// two rows can be almost the same.
    static constexpr double sliver = .1;

    explicit MortarRows(std::size_t n_nodes) : rows(n_nodes) {}

    MortarRow &operator[](const unsigned int node) { return rows[node]; }

    /// These nodes have functions on a sliver.
    void add_sliver(std::vector<unsigned int> nodes) { slivers.push_back(std::move(nodes)); }

    /// Adds rows that differ by less than merge_limit in all weights, and belong to nodes of a
    /// sliver, to the one of larger area: the function there becomes the sum of both.
    void merge_slivers();

    /// The mean gaps of all rows with an area.
    std::vector<SurfaceConstraint> constraints(double thickness) const;

  private:
    bool merge_closest_pair(const std::vector<unsigned int> &nodes);

    std::vector<MortarRow> rows;
    std::vector<std::vector<unsigned int>> slivers;
  };
} // namespace taut

#endif
