// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact surfaces on curves and their loads, for the tests of contact constraints.
#ifndef taut_tests_contact_meshes_h
#define taut_tests_contact_meshes_h

#include <taut/scene/contact_surface.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace contact_meshes
{
  using taut::ContactSurface;
  using taut::Coordinates;
  using taut::SurfaceConstraint;
  using Vectors = std::vector<Coordinates>;

  inline Coordinates times(const double s, const Coordinates &a)
  {
    return {s * a.x, s * a.y, s * a.z};
  }

  inline Coordinates vector_product(const Coordinates &a, const Coordinates &b)
  {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }

  using Curve = std::function<Coordinates(double)>;

  /// y = f(x) of x.
  inline Curve graph(const std::function<double(double)> &f)
  {
    return [f](const double x) { return Coordinates{x, f(x), 0.}; };
  }

  /// A line at a height.
  inline Curve level(const double y)
  {
    return graph([y](double) { return y; });
  }

  /// Positions of the ends of @p n edges from @p begin to @p end; none is shorter than a fifth of
  /// their mean.
  inline std::vector<double> random_grid(const unsigned int n, const double begin, const double end,
                                         std::mt19937 &random)
  {
    std::uniform_real_distribution<double> width(.25, 1.);
    std::vector<double> s(n + 1, 0.);
    for (unsigned int i = 0; i < n; ++i)
      s[i + 1] = s[i] + width(random);
    for (double &x : s)
      x = begin + (end - begin) * x / s[n];
    s[n] = end;
    return s;
  }

  /// A surface of edges on a curve; nodes are numbered at random, edges turned at random.
  /// @p left: the body is on the right of the curve, and outwards is to its left.
  inline ContactSurface on_curve(const std::vector<double> &grid, const unsigned int degree,
                                 const Curve &curve, const bool left, std::mt19937 &random)
  {
    ContactSurface surface;
    surface.name = left ? "lower" : "upper";
    surface.degree = degree;
    const auto n = static_cast<unsigned int>(grid.size() - 1);
    std::vector<unsigned int> number(n * degree + 1);
    for (unsigned int i = 0; i < number.size(); ++i)
      number[i] = i;
    std::shuffle(number.begin(), number.end(), random);
    surface.points.resize(number.size());
    for (unsigned int e = 0; e <= n; ++e)
      surface.points[number[e * degree]] = curve(grid[e]);
    for (unsigned int e = 0; e < n; ++e)
    {
      std::vector<unsigned int> face = {number[e * degree], number[(e + 1) * degree]};
      if (degree == 2)
      {
        face.push_back(number[e * degree + 1]);
        surface.points[face[2]] = curve(.5 * (grid[e] + grid[e + 1]));
      }
      const Coordinates t = surface.points[face[1]] - surface.points[face[0]];
      surface.outward.push_back(left ? Coordinates{-t.y, t.x, 0.} : Coordinates{t.y, -t.x, 0.});
      if (random() % 2)
        std::swap(face[0], face[1]);
      surface.faces.push_back(face);
    }
    return surface;
  }

  /// One surface of two that share no node.
  inline void append(ContactSurface &surface, const ContactSurface &more)
  {
    const auto n = static_cast<unsigned int>(surface.points.size());
    surface.points.insert(surface.points.end(), more.points.begin(), more.points.end());
    for (std::vector<unsigned int> face : more.faces)
    {
      for (unsigned int &node : face)
        node += n;
      surface.faces.push_back(face);
    }
    surface.outward.insert(surface.outward.end(), more.outward.begin(), more.outward.end());
  }

  /// Forces of pressure p = N / area on the nodes of one side.
  inline Vectors forces(const std::vector<SurfaceConstraint> &constraints,
                        const std::vector<taut::NodeWeight> SurfaceConstraint::*side,
                        const std::size_t n_nodes, const double p)
  {
    Vectors force(n_nodes);
    for (const SurfaceConstraint &c : constraints)
      for (const taut::NodeWeight &w : c.*side)
        force[w.node] = add_scaled(force[w.node], p * c.area, w.weight);
    return force;
  }

  /// Consistent loads of a uniform traction on the part from @p begin to @p end of a straight
  /// surface, whose points are origin + s * direction.
  inline Vectors consistent_loads(const ContactSurface &surface, const Coordinates &origin,
                                  const Coordinates &direction, const double begin,
                                  const double end, const Coordinates &traction)
  {
    Vectors load(surface.points.size());
    for (const std::vector<unsigned int> &face : surface.faces)
    {
      double s[2];
      for (unsigned int i = 0; i < 2; ++i)
        s[i] = dot(surface.points[face[i]] - origin, direction);
      const double low = std::max(begin, std::min(s[0], s[1])),
                   high = std::min(end, std::max(s[0], s[1]));
      if (high <= low)
        continue;
      // Simpson's rule.
      const double at[3] = {low, .5 * (low + high), high}, weight[3] = {1. / 6., 2. / 3., 1. / 6.};
      for (unsigned int q = 0; q < 3; ++q)
      {
        const double t = (at[q] - s[0]) / (s[1] - s[0]), w = weight[q] * (high - low);
        const double linear[3] = {1. - t, t, 0.},
                     quadratic[3] = {(1. - t) * (1. - 2. * t), t * (2. * t - 1.),
                                     4. * t * (1. - t)};
        for (unsigned int i = 0; i < face.size(); ++i)
          load[face[i]] = add_scaled(load[face[i]],
                                     w * (surface.degree == 1 ? linear : quadratic)[i], traction);
      }
    }
    return load;
  }

  inline double largest_difference(const Vectors &a, const Vectors &b)
  {
    double largest = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, norm(a[i] - b[i]));
    return largest;
  }

  /// D of displacement fields of both sides.
  inline double gap(const SurfaceConstraint &c, const ContactSurface &slave,
                    const ContactSurface &master,
                    const std::function<Coordinates(const Coordinates &)> &u_slave,
                    const std::function<Coordinates(const Coordinates &)> &u_master)
  {
    double d = c.gap;
    for (const taut::NodeWeight &w : c.slave)
      d += dot(w.weight, u_slave(slave.points[w.node]));
    for (const taut::NodeWeight &w : c.master)
      d += dot(w.weight, u_master(master.points[w.node]));
    return d;
  }

  /// Duration of some work [s].
  inline double seconds_of(const std::function<void()> &work)
  {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  inline double total_area(const std::vector<SurfaceConstraint> &constraints)
  {
    double sum = 0.;
    for (const SurfaceConstraint &c : constraints)
      sum += c.area;
    return sum;
  }
} // namespace contact_meshes

#endif
