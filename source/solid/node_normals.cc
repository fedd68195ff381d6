// SPDX-License-Identifier: LGPL-2.1-or-later
#include "node_normals.h"
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

  std::vector<double> kinks_at_nodes(const ContactSurface &surface)
  {
    constexpr double corner = .5;
    const SurfaceGeometry geometry(surface);
    const NodeNormals normals(geometry);
    std::vector<std::vector<Coordinates>> at_node(surface.points.size());
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
      for (unsigned int i = 0; i < geometry.nodes(f).size(); ++i)
        at_node[geometry.nodes(f)[i]].push_back(normals.at(f, i));
    std::vector<double> result(surface.points.size(), 0.);
    for (std::size_t node = 0; node < result.size(); ++node)
      for (const Coordinates &a : at_node[node])
        for (const Coordinates &b : at_node[node])
          if (const double angle = std::atan2(norm(cross(a, b)), dot(a, b)); angle < corner)
            result[node] = std::max(result[node], angle);
    // Where vertices stand back behind the middles of faces, only those carry.
    std::vector<double> of_faces = result;
    for (const std::vector<unsigned int> &face : surface.faces)
      for (const unsigned int a : face)
        for (const unsigned int b : face)
          of_faces[a] = std::max(of_faces[a], result[b]);
    return of_faces;
  }
} // namespace taut
