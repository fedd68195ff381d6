// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact surfaces on curves and their loads, for the tests of contact constraints.
#ifndef taut_tests_contact_meshes_h
#define taut_tests_contact_meshes_h

#include "common.h"

#include <taut/scene/contact_surface.h>

#include <chrono>

namespace contact_meshes
{
  using taut::ContactSurface;
  using taut::Coordinates;
  using taut::SurfaceConstraint;
  using Constraints = std::vector<SurfaceConstraint>;
  using Vectors = std::vector<Coordinates>;

  constexpr double exact = 1e-13;

  inline Coordinates times(const double s, const Coordinates &a)
  {
    return {s * a.x, s * a.y, s * a.z};
  }

  using Curve = std::function<Coordinates(double)>;

  inline Curve graph(const std::function<double(double)> &f)
  {
    return [f](const double x) { return Coordinates{x, f(x), 0.}; };
  }

  inline Curve level(const double y)
  {
    return [y](const double x) { return Coordinates{x, y, 0.}; };
  }

  /// Ends of @p n edges from @p begin to @p end; none is shorter than a fifth of their mean.
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
    std::iota(number.begin(), number.end(), 0u);
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

  /// Consistent loads of a traction from @p begin to @p end of a surface origin + s * direction.
  inline Vectors consistent_loads(const ContactSurface &surface, const Coordinates &origin,
                                  const Coordinates &direction, const double begin,
                                  const double end, const Coordinates &traction)
  {
    Vectors load(surface.points.size());
    for (const std::vector<unsigned int> &face : surface.faces)
    {
      const double first = dot(surface.points[face[0]] - origin, direction),
                   second = dot(surface.points[face[1]] - origin, direction),
                   low = std::max(begin, std::min(first, second)),
                   high = std::min(end, std::max(first, second));
      if (high <= low)
        continue;
      // Simpson's rule.
      for (const double part : {0., .5, 1.})
      {
        const double w = (part == .5 ? 2. / 3. : 1. / 6.) * (high - low),
                     t = (low + part * (high - low) - first) / (second - first),
                     linear[3] = {1. - t, t, 0.},
                     quadratic[3] = {(1. - t) * (1. - 2. * t), t * (2. * t - 1.),
                                     4. * t * (1. - t)};
        for (unsigned int i = 0; i < face.size(); ++i)
          load[face[i]] = add_scaled(load[face[i]],
                                     w * (surface.degree == 1 ? linear : quadratic)[i], traction);
      }
    }
    return load;
  }

  /// Forces of pressure p = N / area on the nodes of one side.
  inline Vectors forces(const Constraints &constraints,
                        const std::vector<taut::NodeWeight> SurfaceConstraint::*side,
                        const std::size_t n_nodes, const double p)
  {
    Vectors force(n_nodes);
    for (const SurfaceConstraint &c : constraints)
      for (const taut::NodeWeight &w : c.*side)
        force[w.node] = add_scaled(force[w.node], p * c.area, w.weight);
    return force;
  }

  /// Largest difference of these forces from what they have to be.
  inline double error_of_forces(const Constraints &constraints,
                                const std::vector<taut::NodeWeight> SurfaceConstraint::*side,
                                const Vectors &expected, const double p = 1.)
  {
    const Vectors force = forces(constraints, side, expected.size(), p);
    double largest = 0.;
    for (std::size_t i = 0; i < expected.size(); ++i)
      largest = std::max(largest, norm(force[i] - expected[i]));
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

  inline double seconds_of(const std::function<void()> &work)
  {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  inline double total_area(const Constraints &constraints)
  {
    double sum = 0.;
    for (const SurfaceConstraint &c : constraints)
      sum += c.area;
    return sum;
  }
} // namespace contact_meshes

#endif
