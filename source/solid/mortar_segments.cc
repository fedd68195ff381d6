// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/mortar_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace taut
{
  namespace
  {
    /// Cosine between the normals of two edges at a node below which they make a corner.
    constexpr double corner = .5;

    /// Largest distance at which a line of sight may pass a point of an edge, over the length of
    /// the edge.
    constexpr double hit = 1e-6;

    /// Part of an edge below which a segment is rounding.
    constexpr double no_segment = 1e-13;

    double chord(const SurfaceGeometry &geometry, const std::size_t face)
    {
      return norm(geometry.point(geometry.nodes(face)[1]) -
                  geometry.point(geometry.nodes(face)[0]));
    }

    double cross_z(const Coordinates &a, const Coordinates &b)
    {
      return a.x * b.y - a.y * b.x;
    }

    /// A zero in [0, 1] of a function whose values there have different signs, by Newton's method
    /// within a bracket. @p f returns value and derivative.
    template <typename Function>
    double bracketed_root(const Function &f)
    {
      double low = 0., high = 1.;
      const bool rises = f(0.).first < 0.;
      double x = .5, last = 2.;
      for (unsigned int i = 0; i < 100; ++i)
      {
        const auto [value, slope] = f(x);
        if (value == 0.)
          return x;
        ((value < 0.) == rises ? low : high) = x;
        double next = x - value / slope;
        // Bisection if Newton's method leaves the bracket or does not halve its step.
        if (!(next >= low && next <= high) || std::fabs(next - x) > .5 * last)
          next = .5 * (low + high);
        last = std::fabs(next - x);
        x = next;
        if (last <= std::numeric_limits<double>::epsilon() * x)
          return x;
      }
      return x;
    }

    /// Control points of an edge of degree 2 (Bernstein polynomials): the edge is in their hull.
    Coordinates control_point(const Coordinates &first, const Coordinates &second,
                              const Coordinates &middle)
    {
      return add_scaled(scaled(2., middle), -.5, add_scaled(first, 1., second));
    }
  } // namespace

  MortarSegments::MortarSegments(const SurfaceGeometry &slave, const SurfaceGeometry &master,
                                 const double distance, const WholeBoundaries &boundaries)
      : slave(slave), master(master), distance(distance), search(master),
        overlap(slave, master, boundaries), normals(slave.n_faces())
  {
    average_normals();
  }

  void MortarSegments::average_normals()
  {
    struct End
    {
      std::size_t face;
      unsigned int local;
      double length;
    };
    std::vector<std::vector<End>> ends(slave.surface().points.size());
    for (std::size_t f = 0; f < slave.n_faces(); ++f)
    {
      const std::vector<unsigned int> &nodes = slave.nodes(f);
      const double length = chord(slave, f);
      for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        FacePoint p = slave.at(f, {i == 0 ? 0. : i == 1 ? 1. : .5, 0.});
        if (!(p.measure() > 0.))
          p = slave.at(f, centre(FaceForm::line));
        normals[f][i] = p.normal();
        ends[nodes[i]].push_back({f, i, length});
      }
    }
    const std::vector<std::array<Coordinates, 3>> own = normals;
    for (const std::vector<End> &node : ends)
      for (const End &a : node)
      {
        Coordinates sum;
        for (const End &b : node)
          if (dot(own[a.face][a.local], own[b.face][b.local]) >= corner)
            sum = add_scaled(sum, b.length, own[b.face][b.local]);
        normals[a.face][a.local] = normalised(sum);
      }
  }

  MortarSegments::Ray MortarSegments::ray(const std::size_t face, const double at) const
  {
    const FacePoint p = slave.at(face, {at, 0.});
    Ray r;
    r.begin = p.position;
    r.tangent = p.tangent_x;
    for (unsigned int i = 0; i < p.shapes.n; ++i)
    {
      r.direction = add_scaled(r.direction, p.shapes.value[i], normals[face][i]);
      r.turn = add_scaled(r.turn, p.shapes.dx[i], normals[face][i]);
    }
    return r;
  }

  /// Place on the slave edge that sees a point, or the end nearest to the point: 0 or 1.
  double MortarSegments::slave_of(const std::size_t face, const Coordinates &x) const
  {
    const auto side = [this, face, &x](const double at)
    {
      const Ray r = ray(face, at);
      const Coordinates d = x - r.begin;
      return std::make_pair(cross_z(d, r.direction),
                            cross_z(d, r.turn) - cross_z(r.tangent, r.direction));
    };
    const double first = side(0.).first, second = side(1.).first;
    if (first == 0.)
      return 0.;
    if (second == 0.)
      return 1.;
    if ((first < 0.) != (second < 0.))
      return bracketed_root(side);
    // The lines of sight of both ends pass the point on the same side. At the place that sees the
    // point this side falls or rises with the orientation of the edge.
    const Ray r = ray(face, .5);
    return (first > 0.) == (cross_z(r.tangent, r.direction) > 0.) ? 1. : 0.;
  }

  double MortarSegments::project(const std::size_t face, const double at,
                                 const std::size_t other) const
  {
    const Ray r = ray(face, at);
    const auto side = [this, &r, other](const double t)
    {
      const FacePoint p = master.at(other, {t, 0.});
      return std::make_pair(cross_z(p.position - r.begin, r.direction),
                            cross_z(p.tangent_x, r.direction));
    };
    const double first = side(0.).first, second = side(1.).first;
    if ((first < 0.) != (second < 0.))
      return bracketed_root(side);
    return std::fabs(first) < std::fabs(second) ? 0. : 1.; // an end, up to rounding
  }

  std::vector<std::size_t> MortarSegments::candidates(const std::size_t face) const
  {
    const std::vector<unsigned int> &nodes = slave.nodes(face);
    std::vector<Coordinates> x, n(normals[face].begin(), normals[face].begin() + 2);
    for (const unsigned int node : nodes)
      x.push_back(slave.point(node));
    if (nodes.size() == 3)
    {
      x[2] = control_point(x[0], x[1], x[2]);
      n.push_back(control_point(n[0], n[1], normals[face][2]));
    }
    // All points that the edge sees are in the hull of the points that the control points see.
    std::vector<Coordinates> hull;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (const double s : {-std::max(distance, overlap.reach()), distance})
        hull.push_back(add_scaled(x[i], s, n[i]));
    return search.meet_hull(hull);
  }

  /// Distance of the point of a master edge that a place on the slave edge sees [m]. It is infinite
  /// if the edges do not face each other, if the point is too far, or if it is behind and no
  /// overlap that is closed.
  double MortarSegments::gap_of(const std::size_t face, const double at,
                                const std::size_t other) const
  {
    const FacePoint m = master.at(other, {project(face, at, other), 0.});
    const Coordinates normal = slave.at(face, {at, 0.}).normal();
    const Ray r = ray(face, at);
    const Coordinates d = m.position - r.begin;
    const double gap = norm(d);
    const bool hits = std::fabs(cross_z(d, r.direction)) <= hit * norm(r.tangent);
    return hits && -dot(normal, m.normal()) >= facing &&
                   (dot(d, normal) < 0. ? overlap.is_closed(r.begin, m.position) : gap <= distance)
               ? gap
               : std::numeric_limits<double>::infinity();
  }

  void MortarSegments::check_overlap(const std::size_t face, const double at,
                                     const bool no_contact) const
  {
    const FacePoint p = slave.at(face, {at, 0.});
    overlap.check(
        p.position, [&p](const Coordinates &normal) { return -dot(p.normal(), normal) >= facing; },
        no_contact);
  }

  std::vector<MortarSegment> MortarSegments::segments(const std::size_t face) const
  {
    std::vector<MortarSegment> seen;
    std::vector<double> ends;
    for (const std::size_t other : candidates(face))
    {
      const std::vector<unsigned int> &nodes = master.nodes(other);
      const double a = slave_of(face, master.point(nodes[0])),
                   b = slave_of(face, master.point(nodes[1]));
      if (std::fabs(a - b) <= no_segment)
        continue;
      seen.push_back({other, std::min(a, b), std::max(a, b)});
      ends.insert(ends.end(), {a, b});
    }
    std::sort(ends.begin(), ends.end());
    std::stable_sort(seen.begin(), seen.end(),
                     [](const MortarSegment &a, const MortarSegment &b)
                     { return a.begin < b.begin; });

    std::vector<MortarSegment> nearest, here;
    std::size_t next = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    {
      const double begin = ends[k], end = ends[k + 1], middle = .5 * (begin + end);
      if (end - begin <= no_segment)
        continue;
      while (next < seen.size() && seen[next].begin <= middle)
        here.push_back(seen[next++]);
      here.erase(std::remove_if(here.begin(), here.end(),
                                [middle](const MortarSegment &s) { return s.end < middle; }),
                 here.end());
      double smallest = std::numeric_limits<double>::infinity();
      std::size_t best = 0;
      for (const MortarSegment &s : here)
        if (const double gap = gap_of(face, middle, s.master); gap < smallest)
        {
          smallest = gap;
          best = s.master;
        }
      if (std::isfinite(smallest))
        nearest.push_back({best, begin, end});
      else
        check_overlap(face, middle);
    }
    if (ends.empty())
      check_overlap(face, .5);
    return nearest;
  }
} // namespace taut
