// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nodal_areas.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace taut
{
  namespace
  {
    /// What a vertex gets of the functions of the middles beside it.
    constexpr double share = .2;

    /// A face counts for a node if its cosine is at least this part of the largest.
    constexpr double part_of_largest = .5;
  } // namespace

  NodalAreas::NodalAreas(const SurfaceGeometry &geometry)
      : geometry(geometry), faces_of_node(geometry.surface().points.size()),
        integrals(geometry.n_faces(), std::array<double, 9>{}),
        ends(geometry.surface().points.size())
  {
    for (unsigned int node = 0; node < ends.size(); ++node)
      ends[node] = {node, node};
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
    {
      const std::vector<unsigned int> &nodes = geometry.nodes(f);
      for (const unsigned int node : nodes)
        faces_of_node[node].push_back(f);
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

  Coordinates NodalAreas::normal(const std::size_t face, const unsigned int node) const
  {
    const std::vector<unsigned int> &nodes = geometry.nodes(face);
    const auto local =
        static_cast<unsigned int>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
    const unsigned int degree = geometry.surface().degree;
    ReferencePoint at = centre(geometry.form(face));
    if (geometry.form(face) == FaceForm::line)
      at.x = local == 0 ? 0. : local == 1 ? 1. : .5;
    for (const FaceEdge &edge : face_edges(geometry.form(face), degree))
      if (local == edge.first)
        at = edge.begin;
      else if (degree == 2 && local == edge.middle)
        at = {.5 * (edge.begin.x + edge.end.x), .5 * (edge.begin.y + edge.end.y)};
    FacePoint p = geometry.at(face, at);
    if (!(p.measure() > 0.)) // a corner of an angle of zero
      p = geometry.at(face, centre(geometry.form(face)));
    return p.normal();
  }

  double NodalAreas::largest_cosine(const unsigned int node, const Coordinates &direction) const
  {
    double largest = -std::numeric_limits<double>::infinity();
    for (const std::size_t f : faces(node))
      largest = std::max(largest, dot(normal(f, node), direction));
    return largest;
  }

  double NodalAreas::area(const unsigned int node, const Coordinates &direction) const
  {
    const double largest = largest_cosine(node, direction);
    double sum = 0.;
    for (const std::size_t f : faces(node))
      if (dot(normal(f, node), direction) >= part_of_largest * largest)
      {
        const std::vector<unsigned int> &nodes = geometry.nodes(f);
        sum += integrals[f][static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) -
                                                     nodes.begin())];
      }
    if (!(sum > 0.))
    {
      const Coordinates x = geometry.point(node);
      throw UserError("contact surface '" + geometry.surface().name +
                      "': the integral of the shape function of the node at (" + to_text(x.x) +
                      ", " + to_text(x.y) + ", " + to_text(x.z) +
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
