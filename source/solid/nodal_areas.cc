// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/nodal_areas.h"
#include "base/text.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace taut
{
  namespace
  {
    /// Part of the functions of the adjacent middles that a vertex gets.
    constexpr double share = .2;

    /// A face counts for a node if its cosine is at least this part of the largest cosine.
    constexpr double part_of_largest = .5;
  } // namespace

  NodalAreas::NodalAreas(const SurfaceGeometry &geometry)
      : geometry(geometry), normals(geometry), faces_of_node(geometry.surface().points.size()),
        integrals(geometry.n_faces(), std::array<double, 9>{}),
        ends(geometry.surface().points.size())
  {
    for (unsigned int node = 0; node < ends.size(); ++node)
      ends[node] = {node, node};
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
    {
      const std::vector<unsigned int> &nodes = geometry.nodes(f);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        faces_of_node[nodes[i]].push_back({f, i});
      if (geometry.form(f) == FaceForm::triangle && geometry.surface().degree == 2)
        for (const FaceEdge &edge : face_edges(FaceForm::triangle, 2))
          ends[nodes[edge.middle]] = {nodes[edge.first], nodes[edge.second]};
    }
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
      integrate(f);
  }

  void NodalAreas::integrate(const std::size_t face)
  {
    std::array<double, 9> &integral = integrals[face];
    const FaceForm form = geometry.form(face);
    for (const QuadraturePoint &q : face_quadrature(form))
    {
      const FacePoint p = geometry.at(face, q.at);
      for (unsigned int i = 0; i < p.shapes.n; ++i)
        integral[i] += q.weight * p.measure() * p.shapes.value[i];
    }
    if (geometry.surface().degree == 1)
      return;
    const std::vector<unsigned int> &nodes = geometry.nodes(face);
    for (const FaceEdge &edge : face_edges(form, 2))
      if (ends[nodes[edge.middle]][0] != nodes[edge.middle])
      {
        double &middle = integral[edge.middle];
        integral[edge.first] += share * middle;
        integral[edge.second] += share * middle;
        middle *= 1. - 2. * share;
      }
  }

  double NodalAreas::largest_cosine(const unsigned int node, const Coordinates &direction) const
  {
    double largest = -std::numeric_limits<double>::infinity();
    for (const NodeOfFace &f : faces(node))
      largest = std::max(largest, dot(normals.at(f.face, f.local), direction));
    return largest;
  }

  std::vector<std::size_t> NodalAreas::faces_along(const unsigned int node,
                                                   const Coordinates &direction) const
  {
    const double largest = largest_cosine(node, direction);
    std::vector<std::size_t> result;
    for (const NodeOfFace &f : faces(node))
      if (dot(normals.at(f.face, f.local), direction) >= part_of_largest * largest)
        result.push_back(f.face);
    return result;
  }

  double NodalAreas::area(const unsigned int node, const Coordinates &direction) const
  {
    const double largest = largest_cosine(node, direction);
    double sum = 0.;
    for (const NodeOfFace &f : faces(node))
      if (dot(normals.at(f.face, f.local), direction) >= part_of_largest * largest)
        sum += integrals[f.face][f.local];
    if (!(sum > 0.))
    {
      const Coordinates x = geometry.point(node);
      throw UserError("contact surface '" + geometry.surface().name +
                      "': the integral of the shape function of the node at (" + to_text(x) +
                      ") is not positive: the faces at it are too distorted");
    }
    return sum;
  }

  std::vector<std::pair<unsigned int, double>> NodalAreas::amplitude(const unsigned int node) const
  {
    const auto [first, second] = ends[node];
    if (first == node)
      return {{node, 1.}};
    return {{node, 1. / (1. - 2. * share)},
            {first, -share / (1. - 2. * share)},
            {second, -share / (1. - 2. * share)}};
  }
} // namespace taut
