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
    double uncovered = 0.;      ///< see SurfaceConstraint
    Coordinates point, normal;
    NodeVectors slave, master;
  };

  /// The rows of the nodes of the slave.
  class MortarRows
  {
  public:
    /// An edge is a sliver if less than this part of it is covered, from begin to end.
    static constexpr double sliver = .1;

    explicit MortarRows(std::size_t n_nodes) : rows(n_nodes) {}

    MortarRow &operator[](const unsigned int node) { return rows[node]; }

    /// These nodes have functions on a sliver.
    void add_sliver(std::vector<unsigned int> nodes) { slivers.push_back(std::move(nodes)); }

    /**
     * Merges rows of nodes of a sliver. The function of a merged row is the sum of their functions,
     * and its node is that of the largest area. If an area is less than a tenth of the largest
     * area, as beside a completely covered edge, all rows become one: the multiplier is constant on
     * the sliver. Otherwise pairs become one if their rows, as means, differ by less than 0.1 in
     * all weights: displacements could not distinguish them.
     */
    void merge_slivers();

    /// The mean gaps of all rows with an area.
    std::vector<SurfaceConstraint> constraints(double thickness) const;

  private:
    void merge(unsigned int gone, unsigned int kept);
    bool merge_small(const std::vector<unsigned int> &nodes);
    bool merge_closest_pair(const std::vector<unsigned int> &nodes);

    std::vector<MortarRow> rows;
    std::vector<std::vector<unsigned int>> slivers;
  };
} // namespace taut

#endif
