// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_face_shapes_h
#define taut_face_shapes_h

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace taut
{
  /// A place on the reference face: [0, 1], [0, 1]^2, or the triangle (0, 0), (1, 0), (0, 1).
  struct ReferencePoint
  {
    double x = 0., y = 0.;
  };

  inline bool operator==(const ReferencePoint &a, const ReferencePoint &b)
  {
    return a.x == b.x && a.y == b.y;
  }

  /// Forms of faces, see ContactSurface.
  enum class FaceForm
  {
    none, ///< there is no such face
    line,
    quadrilateral,
    triangle
  };

  /// The form of a face with this number of nodes.
  FaceForm face_form(unsigned int dim, unsigned int degree, std::size_t n_nodes);

  /// Shape functions of a face of up to nine nodes and their first and second derivatives.
  struct FaceShapes
  {
    unsigned int n = 0;
    std::array<double, 9> value{}, dx{}, dy{}, dxx{}, dxy{}, dyy{};
  };
  FaceShapes face_shapes(FaceForm form, unsigned int degree, const ReferencePoint &at);

  ReferencePoint centre(FaceForm form);

  /// A straight line on the reference face with nodes of the face as its ends; @p middle is the
  /// node between them if the degree is 2.
  struct FaceEdge
  {
    ReferencePoint begin, end;
    unsigned int first = 0, second = 0, middle = 0;
  };

  /// The border of a face in space.
  const std::vector<FaceEdge> &face_edges(FaceForm form, unsigned int degree);

  struct QuadraturePoint
  {
    ReferencePoint at;
    double weight = 0.;
  };

  /// Gauss points and weights on [0, 1], exact up to degree 11.
  const std::array<std::pair<double, double>, 6> &gauss_points();

  /// Quadrature on a reference face, exact for polynomials of degree 10 at least.
  std::vector<QuadraturePoint> face_quadrature(FaceForm form);
} // namespace taut

#endif
