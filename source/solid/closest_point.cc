// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/closest_point.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace taut
{
  namespace
  {
    /// Change of a reference coordinate that ends Newton's method; the next change would be its
    /// square.
    constexpr double converged = 1e-11;
    constexpr unsigned int most_iterations = 50;

    /// Number of starts along a line, beside its ends.
    constexpr double starts[] = {.5, .2, .8};

    std::array<unsigned int, 2> key(const unsigned int a, const unsigned int b)
    {
      return {std::min(a, b), std::max(a, b)};
    }

    ReferencePoint between(const ReferencePoint &a, const ReferencePoint &b, const double t)
    {
      return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    }

    bool is_within(const FaceForm form, const ReferencePoint &r)
    {
      return r.x > 0. && r.y > 0. &&
             (form == FaceForm::triangle ? r.x + r.y < 1. : r.x < 1. && r.y < 1.);
    }
  } // namespace

  ClosestPoints::ClosestPoints(const SurfaceGeometry &geometry) : geometry(geometry)
  {
    std::vector<unsigned int> edges_of_node(geometry.surface().points.size(), 0);
    for (std::size_t f = 0; f < geometry.n_faces(); ++f)
    {
      const std::vector<unsigned int> &nodes = geometry.nodes(f);
      if (geometry.form(f) == FaceForm::line)
      {
        ++edges_of_node[nodes[0]];
        ++edges_of_node[nodes[1]];
      }
      for (const FaceEdge &edge : face_edges(geometry.form(f), geometry.surface().degree))
        if (const auto k = key(nodes[edge.first], nodes[edge.second]);
            !single_edges.insert(k).second)
          single_edges.erase(k);
    }
    for (unsigned int node = 0; node < edges_of_node.size(); ++node)
      if (edges_of_node[node] == 1)
        border_nodes.insert(node);
    for (const auto &edge : single_edges)
      border_nodes.insert(edge.begin(), edge.end());
  }

  ClosestPoint ClosestPoints::find(const std::size_t face, const Coordinates &x) const
  {
    ClosestPoint closest;
    closest.face = face;
    closest.distance = std::numeric_limits<double>::infinity();
    if (geometry.form(face) == FaceForm::line)
      find_in_plane(closest, x);
    else
      find_in_space(closest, x);
    return closest;
  }

  void ClosestPoints::find_in_plane(ClosestPoint &closest, const Coordinates &x) const
  {
    closest.reference = on_line(closest.face, x, {0., 0.}, {1., 0.});
    closest.distance = norm(x - geometry.at(closest.face, closest.reference).position);
    const double at = closest.reference.x;
    closest.on_border = at == 0. || at == 1.;
    closest.on_open_border =
        closest.on_border && border_nodes.count(geometry.nodes(closest.face)[at == 0. ? 0 : 1]) > 0;
  }

  void ClosestPoints::find_in_space(ClosestPoint &closest, const Coordinates &x) const
  {
    const std::size_t face = closest.face;
    if (const std::optional<ReferencePoint> r = inside(face, x))
    {
      closest.reference = *r;
      closest.distance = norm(x - geometry.at(face, *r).position);
    }
    const std::vector<unsigned int> &nodes = geometry.nodes(face);
    for (const FaceEdge &edge : face_edges(geometry.form(face), geometry.surface().degree))
    {
      const ReferencePoint r = on_line(face, x, edge.begin, edge.end);
      const double distance = norm(x - geometry.at(face, r).position);
      if (!(distance < closest.distance))
        continue;
      closest.reference = r;
      closest.distance = distance;
      closest.on_border = true;
      const unsigned int first = nodes[edge.first], second = nodes[edge.second];
      closest.on_open_border = r == edge.begin ? border_nodes.count(first) > 0
                               : r == edge.end ? border_nodes.count(second) > 0
                                               : single_edges.count(key(first, second)) > 0;
    }
  }

  /// A minimum of the distance inside the face, if Newton's method from the centre finds one.
  std::optional<ReferencePoint> ClosestPoints::inside(const std::size_t face,
                                                      const Coordinates &x) const
  {
    ReferencePoint r = centre(geometry.form(face));
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      const FacePoint p = geometry.at(face, r);
      const Coordinates d = p.position - x;
      Coordinates xx, xy, yy; // second derivatives
      for (unsigned int k = 0; k < p.shapes.n; ++k)
      {
        const Coordinates node = geometry.point(geometry.nodes(face)[k]);
        xx = add_scaled(xx, p.shapes.dxx[k], node);
        xy = add_scaled(xy, p.shapes.dxy[k], node);
        yy = add_scaled(yy, p.shapes.dyy[k], node);
      }
      const double g[2] = {dot(d, p.tangent_x), dot(d, p.tangent_y)};
      double a = dot(p.tangent_x, p.tangent_x), b = dot(p.tangent_x, p.tangent_y),
             c = dot(p.tangent_y, p.tangent_y);
      // Without second derivatives (Gauss-Newton) if the full Hessian has no minimum.
      const double h[3] = {a + dot(d, xx), b + dot(d, xy), c + dot(d, yy)};
      if (h[0] > 0. && h[0] * h[2] - h[1] * h[1] > 0.)
      {
        a = h[0];
        b = h[1];
        c = h[2];
      }
      const double determinant = a * c - b * b;
      if (!(determinant > 0.))
        return std::nullopt;
      const double step_x = (b * g[1] - c * g[0]) / determinant,
                   step_y = (b * g[0] - a * g[1]) / determinant;
      const double largest = std::max(std::fabs(step_x), std::fabs(step_y));
      const double part = largest > .5 ? .5 / largest : 1.;
      r = {r.x + part * step_x, r.y + part * step_y};
      if (std::fabs(r.x - .5) > 2. || std::fabs(r.y - .5) > 2.)
        return std::nullopt;
      if (largest <= converged)
        break;
    }
    if (!is_within(geometry.form(face), r))
      return std::nullopt;
    return r;
  }

  /// The closest point of a straight line of the reference face.
  ReferencePoint ClosestPoints::on_line(const std::size_t face, const Coordinates &x,
                                        const ReferencePoint &begin,
                                        const ReferencePoint &end) const
  {
    const double vx = end.x - begin.x, vy = end.y - begin.y;
    const auto distance = [&](const double t)
    { return norm(x - geometry.at(face, between(begin, end, t)).position); };
    double best = distance(0.) <= distance(1.) ? 0. : 1., smallest = distance(best);
    // A straight line needs one start only.
    const std::size_t n_starts = geometry.surface().degree == 1 ? 1 : std::size(starts);
    for (std::size_t s = 0; s < n_starts; ++s)
    {
      double t = starts[s];
      for (unsigned int i = 0; i < most_iterations; ++i)
      {
        const FacePoint p = geometry.at(face, between(begin, end, t));
        const Coordinates d = p.position - x,
                          tangent = add_scaled(scaled(vx, p.tangent_x), vy, p.tangent_y);
        double curvature = 0.;
        for (unsigned int k = 0; k < p.shapes.n; ++k)
          curvature += (vx * vx * p.shapes.dxx[k] + 2. * vx * vy * p.shapes.dxy[k] +
                        vy * vy * p.shapes.dyy[k]) *
                       dot(d, geometry.point(geometry.nodes(face)[k]));
        const double square = dot(tangent, tangent),
                     second = square + curvature > 0. ? square + curvature : square;
        if (!(second > 0.))
          break;
        const double next = std::min(std::max(t - dot(d, tangent) / second, 0.), 1.),
                     change = std::fabs(next - t);
        t = next;
        if (change <= converged)
          break;
      }
      if (const double d = distance(t); d < smallest)
      {
        best = t;
        smallest = d;
      }
    }
    return between(begin, end, best);
  }
} // namespace taut
