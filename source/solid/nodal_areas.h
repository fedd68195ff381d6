// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_nodal_areas_h
#define taut_nodal_areas_h

#include "solid/surface_geometry.h"

#include <array>
#include <functional>
#include <vector>

namespace taut
{
  /// Outer unit normals of faces at their nodes, not averaged between faces.
  class NodeNormals
  {
  public:
    explicit NodeNormals(const SurfaceGeometry &geometry);

    /// At a node of a face, in the order of the face's nodes.
    const Coordinates &at(const std::size_t face, const std::size_t local) const
    {
      return normals[face][local];
    }

  private:
    std::vector<std::vector<Coordinates>> normals;
  };

  /**
   * Integrals of the dual basis functions of the nodes, which are the integrals of the shape
   * functions, on the faces that count for each node. At edges of triangles of degree 2 the basis
   * is changed, so that all integrals are positive [Popp et al. 2012]. With nodes a, b and m
   * between them the functions are phi_a + s phi_m, phi_b + s phi_m, (1 - 2 s) phi_m with s = 1/5.
   */
  class NodalAreas
  {
  public:
    explicit NodalAreas(const SurfaceGeometry &geometry);

    struct NodeOfFace
    {
      std::size_t face;
      unsigned int local; ///< number of the node in the face
    };

    /// Faces of a node. A node without faces has no area.
    const std::vector<NodeOfFace> &faces(const unsigned int node) const
    {
      return faces_of_node[node];
    }

    /// The largest cosine of the faces of a node to @p direction.
    double largest_cosine(unsigned int node, const Coordinates &direction) const;

    /// The faces that area() counts.
    std::vector<std::size_t> faces_along(unsigned int node, const Coordinates &direction) const;

    /// Integral [m, m^2] over the faces of a node whose cosine to @p direction is at least half of
    /// the largest cosine. Throws UserError if a distorted face makes the integral not positive.
    double area(unsigned int node, const Coordinates &direction) const;

    /// The amplitude of the basis function of a node as a sum of values at nodes: the value at the
    /// node, unless the basis is changed.
    std::vector<std::pair<unsigned int, double>> amplitude(unsigned int node) const;

  private:
    void integrate(std::size_t face);

    const SurfaceGeometry &geometry;
    NodeNormals normals;
    std::vector<std::vector<NodeOfFace>> faces_of_node;
    std::vector<std::array<double, 9>> integrals; ///< of the nodes of each face

    /// For each node the ends of the edge whose middle it is, if the basis is changed there;
    /// otherwise the node twice.
    std::vector<std::array<unsigned int, 2>> ends;
  };
} // namespace taut

#endif
