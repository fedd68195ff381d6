// SPDX-License-Identifier: LGPL-2.1-or-later

#include "solid/nodal_areas.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/solid/contact_constraints.h>

#include <algorithm>
#include <cmath>
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

  namespace
  {
    /// Places of the nodes of a face on its reference face.
    std::vector<ReferencePoint> node_places(const FaceForm form, const unsigned int degree,
                                            const std::size_t n_nodes)
    {
      std::vector<ReferencePoint> places(n_nodes, centre(form));
      if (form == FaceForm::line)
      {
        places[0].x = 0.;
        places[1].x = 1.;
      }
      for (const FaceEdge &edge : face_edges(form, degree))
      {
        places[edge.first] = edge.begin;
        if (degree == 2)
          places[edge.middle] = {.5 * (edge.begin.x + edge.end.x),
                                 .5 * (edge.begin.y + edge.end.y)};
      }
      return places;
    }
  } // namespace

  NodeNormals::NodeNormals(const SurfaceGeometry &geometry) : normals(geometry.n_faces())
  {
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
      for (const ReferencePoint &place :
           node_places(geometry.form(f), geometry.surface().degree, geometry.nodes(f).size()))
      {
        FacePoint p = geometry.at(f, place);
        if (!(p.measure() > 0.)) // a corner of an angle of zero
          p = geometry.at(f, centre(geometry.form(f)));
        normals[f].push_back(p.normal());
      }
  }

  std::vector<double> heights_of_arcs(const ContactSurface &surface)
  {
    constexpr double corner = .5, follows = .5;
    static const std::vector<FaceEdge> line = {{{0., 0.}, {1., 0.}, 0, 1, 2}};
    const SurfaceGeometry geometry(surface);
    const NodeNormals normals(geometry);
    std::vector<std::vector<Coordinates>> at_node(surface.points.size());
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
      for (unsigned int i = 0; i < geometry.nodes(f).size(); ++i)
        at_node[geometry.nodes(f)[i]].push_back(normals.at(f, i));
    const auto angle = [](const Coordinates &a, const Coordinates &b)
    { return std::atan2(norm(cross(a, b)), dot(a, b)); };
    // Of the mean normal at a node of a face, to the normal of a chord.
    const auto inclination =
        [&](const std::size_t f, const unsigned int i, const Coordinates &chord)
    {
      Coordinates sum;
      for (const Coordinates &n : at_node[geometry.nodes(f)[i]])
        if (angle(n, normals.at(f, i)) < corner)
          sum = add_scaled(sum, 1., n);
      return std::fabs(std::asin(dot(sum, chord) / (norm(sum) * norm(chord))));
    };
    std::vector<double> result(surface.points.size(), 0.);
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
    {
      const std::vector<unsigned int> &nodes = geometry.nodes(f);
      double height = 0.;
      for (const FaceEdge &edge :
           surface.dim == 2 ? line : face_edges(geometry.form(f), surface.degree))
      {
        const Coordinates a = geometry.point(nodes[edge.first]),
                          b = geometry.point(nodes[edge.second]);
        // Where the curve ends, the mean normal is that of the chord.
        const double of_arc =
            std::max(inclination(f, edge.first, b - a), inclination(f, edge.second, b - a)) *
            norm(b - a) / 4.;
        if (surface.degree == 1 || norm(geometry.point(nodes[edge.middle]) -
                                        scaled(.5, add_scaled(a, 1., b))) < follows * of_arc)
          height = std::max(height, of_arc);
      }
      for (const unsigned int node : nodes)
        result[node] = std::max(result[node], height);
    }
    return result;
  }
} // namespace taut
