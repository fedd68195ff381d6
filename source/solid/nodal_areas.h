// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_nodal_areas_h
#define taut_nodal_areas_h

#include "node_normals.h"
#include "surface_geometry.h"

#include <array>
#include <functional>
#include <vector>

namespace taut
{
  /**
   * Integrals of the dual basis functions of the nodes, those of the shape functions, on the faces
   * that count for each node. Where an edge belongs to a triangle of degree 2 the basis is changed
   * so that all integrals are positive [Popp et al. 2012]: with nodes a, b and m between them
   * phi_a + s phi_m, phi_b + s phi_m, (1 - 2 s) phi_m with s = 1/5.
   */
  class NodalAreas
  {
  public:
    explicit NodalAreas(const SurfaceGeometry &geometry);

    struct NodeOfFace
    {
      std::size_t face;
      unsigned int local; ///< which of its nodes
    };

    /// Faces of a node. A node without one has no area.
    const std::vector<NodeOfFace> &faces(const unsigned int node) const
    {
      return faces_of_node[node];
    }

    /// Of all faces of a node, how closely the best faces the @p direction: the largest cosine.
    double largest_cosine(unsigned int node, const Coordinates &direction) const;

    /// The faces that area() counts.
    std::vector<std::size_t> faces_along(unsigned int node, const Coordinates &direction) const;

    /// Integral [m, m^2] over those faces of a node whose cosine to @p direction is at least half
    /// of the largest. Throws UserError if a face is so distorted that it is not positive.
    double area(unsigned int node, const Coordinates &direction) const;

    /// The amplitude of a node's basis function as a sum of values at nodes: the node itself but
    /// for a changed basis.
    std::vector<std::pair<unsigned int, double>> amplitude(unsigned int node) const;

  private:
    void integrate(std::size_t face);

    const SurfaceGeometry &geometry;
    NodeNormals normals;
    std::vector<std::vector<NodeOfFace>> faces_of_node;
    std::vector<std::array<double, 9>> integrals; ///< of the nodes of each face

    /// Of each node, those of the edge whose middle it is, if the basis is changed there; else
    /// twice the node itself.
    std::vector<std::array<unsigned int, 2>> ends;
  };
} // namespace taut

#endif
