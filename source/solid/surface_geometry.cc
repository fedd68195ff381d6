// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/surface_geometry.h"
#include "base/text.h"
#include "solid/face_search.h"
#include <taut/base/exceptions.h>
#include <taut/solid/contact_constraints.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    /// A face is degenerate if its area at the centre over the square of its diameter (in the
    /// plane: length over diameter) is below this.
    constexpr double no_area = 1e-12;

    /// Smallest cosine between outward direction and normal at the centre for a clear outer side.
    constexpr double clear_side = .01;

    /// A face of degree 2 leaves the box of its nodes by at most this part of the lengths of the
    /// box: (c - 1) / 2, with the largest sum c = 5/3 of absolute values of the shape functions.
    constexpr double overshoot = 1. / 3.;

    bool is_finite(const Coordinates &x)
    {
      return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
    }
  } // namespace

  void Box::add(const Coordinates &x)
  {
    lower = {std::min(lower.x, x.x), std::min(lower.y, x.y), std::min(lower.z, x.z)};
    upper = {std::max(upper.x, x.x), std::max(upper.y, x.y), std::max(upper.z, x.z)};
  }

  SurfaceGeometry::SurfaceGeometry(const ContactSurface &surface) : description(surface)
  {
    const std::string what = "contact surface '" + surface.name + "'";
    if (surface.dim != 2 && surface.dim != 3)
      throw UserError(what + ": its dimension is " + std::to_string(surface.dim) +
                      "; it must be 2 or 3");
    if (surface.degree != 1 && surface.degree != 2)
      throw UserError(what + ": its degree is " + std::to_string(surface.degree) +
                      "; contact is for elements of degree 1 and 2");
    if (surface.faces.empty())
      throw UserError(what + " has no faces: check the boundary id that it is made of");
    if (surface.outward.size() != surface.faces.size())
      throw UserError(what + " has " + std::to_string(surface.faces.size()) + " faces, but " +
                      std::to_string(surface.outward.size()) + " outward directions");
    forms.reserve(surface.faces.size());
    sides.reserve(surface.faces.size());
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
    {
      check_nodes(f);
      forms.push_back(face_form(surface.dim, surface.degree, surface.faces[f].size()));
      if (forms[f] == FaceForm::none)
        complain(f, "has " + std::to_string(surface.faces[f].size()) +
                        " nodes, which no face of degree " + std::to_string(surface.degree) +
                        " has");
      sides.push_back(1.);
      Coordinates outward = surface.outward[f];
      if (surface.dim == 2)
        outward.z = 0.;
      const FacePoint middle = at(f, centre(forms[f]));
      const double diameter = box(f).diagonal();
      if (!(middle.measure() > no_area * std::pow(diameter, surface.dim - 1)))
        complain(f, "has no area: nodes coincide or lie on a line");
      const double side = dot(middle.normal(), outward);
      if (!is_finite(outward) || !(std::fabs(side) > clear_side * norm(outward)))
        complain(f, "has an outward direction along the face: it must point out of the body");
      sides[f] = side > 0. ? 1. : -1.;
    }
  }

  void SurfaceGeometry::complain(const std::size_t face, const std::string &what) const
  {
    std::string where;
    if (!description.faces[face].empty() && description.faces[face][0] < description.points.size())
    {
      const Coordinates x = point(description.faces[face][0]);
      where = to_text(" at (", x, ")");
    }
    throw UserError("contact surface '" + description.name + "': face " + std::to_string(face) +
                    where + " " + what);
  }

  void SurfaceGeometry::check_nodes(const std::size_t face) const
  {
    for (const unsigned int node : description.faces[face])
      if (node >= description.points.size())
        complain(face, "names node " + std::to_string(node) + " of " +
                           std::to_string(description.points.size()));
      else if (!is_finite(point(node)))
        complain(face, "has a node whose position is no number");
  }

  Coordinates SurfaceGeometry::point(const unsigned int node) const
  {
    Coordinates x = description.points[node];
    if (description.dim == 2)
      x.z = 0.;
    return x;
  }

  FacePoint SurfaceGeometry::at(const std::size_t face, const ReferencePoint &reference) const
  {
    FacePoint p;
    p.shapes = face_shapes(forms[face], description.degree, reference);
    for (unsigned int i = 0; i < p.shapes.n; ++i)
    {
      const Coordinates x = point(nodes(face)[i]);
      p.position = add_scaled(p.position, p.shapes.value[i], x);
      p.tangent_x = add_scaled(p.tangent_x, p.shapes.dx[i], x);
      p.tangent_y = add_scaled(p.tangent_y, p.shapes.dy[i], x);
    }
    p.area = description.dim == 2 ? Coordinates{p.tangent_x.y, -p.tangent_x.x, 0.}
                                  : cross(p.tangent_x, p.tangent_y);
    p.area = scaled(sides[face], p.area);
    return p;
  }

  Box SurfaceGeometry::box(const std::size_t face) const
  {
    const Coordinates first = point(nodes(face)[0]);
    Box box{first, first};
    for (const unsigned int node : nodes(face))
      box.add(point(node));
    if (description.degree > 1)
    {
      const Coordinates size = box.upper - box.lower;
      box.add(add_scaled(box.lower, -overshoot, size));
      box.add(add_scaled(box.upper, overshoot, size));
    }
    return box;
  }

  Box SurfaceGeometry::bounding_box() const
  {
    Box all = box(0);
    for (std::size_t f = 1; f < n_faces(); ++f)
    {
      const Box one = box(f);
      all.add(one.lower);
      all.add(one.upper);
    }
    return all;
  }

  void check_dimensions(const ContactSurface &a, const ContactSurface &b)
  {
    if (a.dim != b.dim)
      throw UserError("contact surfaces '" + a.name + "' and '" + b.name + "' have dimensions " +
                      std::to_string(a.dim) + " and " + std::to_string(b.dim) +
                      ": only bodies of the same dimension can touch");
  }

  void check_thickness(const double thickness)
  {
    if (!(thickness > 0.) || std::isinf(thickness))
      throw UserError("contact surfaces: the thickness is " + to_text(thickness) +
                      " m, it must be positive");
  }

  double search_distance(const SurfaceGeometry &slave, const SurfaceGeometry &master,
                         const double distance)
  {
    if (distance == automatic_search_distance)
      return std::min(slave.bounding_box().diagonal(), master.bounding_box().diagonal());
    if (!(distance > 0.))
      throw UserError("contact surfaces '" + slave.surface().name + "' and '" +
                      master.surface().name + "': the search distance is " + to_text(distance) +
                      " m, it must be positive");
    return distance;
  }

  void complain_about_search(const SurfaceGeometry &slave, const SurfaceGeometry &master,
                             const double distance)
  {
    const FaceSearch search(master);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < slave.n_faces(); ++f)
      search.visit_nearest(slave.at(f, centre(slave.form(f))).position,
                           [&nearest](std::size_t, const double d)
                           {
                             nearest = std::min(nearest, d);
                             return false;
                           });
    throw UserError("contact surfaces '" + slave.surface().name + "' and '" +
                    master.surface().name + "': no face of the first faces the second within " +
                    to_text(distance) + " m; the smallest distance between them is about " +
                    to_text(nearest) +
                    " m. Check boundary ids and positions, or enlarge the search distance");
  }
} // namespace taut
