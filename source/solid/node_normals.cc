// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/node_normals.h"
#include <taut/solid/contact_constraints.h>

#include <algorithm>
#include <cmath>

namespace taut
{
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
