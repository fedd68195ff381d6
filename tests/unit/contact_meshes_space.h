// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact surfaces in space, of squares and spheres, for the tests of contact constraints.
#ifndef taut_tests_contact_meshes_space_h
#define taut_tests_contact_meshes_space_h

#include "contact_meshes.h"

namespace contact_meshes
{
  struct Form
  {
    unsigned int degree;
    bool triangles;
  };
  inline const Form forms[] = {{1, false}, {2, false}, {1, true}, {2, true}};

  /// n by n squares, or twice as many triangles, of [0, 1]^2, mapped; nodes are shared where they
  /// coincide after the map. @p shift moves inner lines at random, by a part of a square.
  inline void add_patch(ContactSurface &surface, const unsigned int n, const bool triangles,
                        const std::function<Coordinates(double, double)> &map,
                        const Coordinates &outward, const double shift, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> part(-shift, shift);
    const unsigned int degree = surface.degree, m = n * degree;
    std::vector<std::vector<std::pair<double, double>>> grid(n + 1);
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
      {
        const bool is_inner = i > 0 && i < n && j > 0 && j < n;
        const double dx = is_inner ? part(random) : 0., dy = is_inner ? part(random) : 0.;
        grid[j].push_back({(i + dx) / n, (j + dy) / n});
      }
    std::map<std::tuple<long, long, long>, unsigned int> known;
    const auto key = [](const Coordinates &x)
    { return std::tuple(std::lround(1e7 * x.x), std::lround(1e7 * x.y), std::lround(1e7 * x.z)); };
    for (unsigned int i = 0; i < surface.points.size(); ++i)
      known[key(surface.points[i])] = i;
    std::vector<unsigned int> number((m + 1) * (m + 1));
    for (unsigned int j = 0; j <= m; ++j)
      for (unsigned int i = 0; i <= m; ++i)
      {
        // Middles between the corners of the square, straight on the parameters' plane.
        const unsigned int i0 = i / degree, j0 = j / degree, i1 = (i + degree - 1) / degree,
                           j1 = (j + degree - 1) / degree;
        double x = 0., y = 0.;
        if (triangles && i0 != i1 && j0 != j1)
        { // on the diagonal
          x = .5 * (grid[j0][i1].first + grid[j1][i0].first);
          y = .5 * (grid[j0][i1].second + grid[j1][i0].second);
        }
        else
          for (const auto &[a, b] : {std::make_pair(i0, j0), {i0, j1}, {i1, j0}, {i1, j1}})
          {
            x += .25 * grid[b][a].first;
            y += .25 * grid[b][a].second;
          }
        const Coordinates place = map(x, y);
        const auto found = known.insert({key(place), unsigned(surface.points.size())});
        if (found.second)
          surface.points.push_back(place);
        number[j * (m + 1) + i] = found.first->second;
      }
    // Places of the nodes of a face in the square: corners of triangles, then middles.
    using Places = std::vector<std::array<unsigned int, 2>>;
    Places all;
    for (unsigned int b = 0; b <= degree; ++b)
      for (unsigned int a = 0; a <= degree; ++a)
        all.push_back({a, b});
    const std::vector<Places> faces =
        !triangles    ? std::vector<Places>{all}
        : degree == 1 ? std::vector<Places>{{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {1, 1}, {0, 1}}}
                      : std::vector<Places>{{{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 1}, {0, 1}},
                                            {{2, 0}, {2, 2}, {0, 2}, {2, 1}, {1, 2}, {1, 1}}};
    for (unsigned int j = 0; j < m; j += degree)
      for (unsigned int i = 0; i < m; i += degree)
        for (const Places &places : faces)
        {
          surface.faces.emplace_back();
          for (const auto &[a, b] : places)
            surface.faces.back().push_back(number[(j + b) * (m + 1) + i + a]);
        }
    surface.outward.resize(surface.faces.size(), outward);
  }

  /// A patch of the plane z = 0 under a body, or turned.
  inline ContactSurface square(const Form &form, const unsigned int n, std::mt19937 &random,
                               const Coordinates &origin = {}, const Coordinates &e1 = {1., 0., 0.},
                               const Coordinates &e2 = {0., 1., 0.}, const double side = -1.)
  {
    ContactSurface surface;
    surface.name = "square";
    surface.dim = 3;
    surface.degree = form.degree;
    add_patch(
        surface, n, form.triangles,
        [&](const double x, const double y)
        { return add_scaled(add_scaled(origin, x, e1), y, e2); },
        times(side, cross(e1, e2)), .2, random);
    return surface;
  }

  /// A sphere about the origin, from the six sides of a cube.
  inline ContactSurface sphere(const Form &form, const unsigned int n, const double radius,
                               std::mt19937 &random)
  {
    ContactSurface surface;
    surface.name = "sphere";
    surface.dim = 3;
    surface.degree = form.degree;
    const Coordinates axes[3] = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
    for (unsigned int a = 0; a < 3; ++a)
      for (const double side : {-1., 1.})
        add_patch(
            surface, n, form.triangles,
            [&](const double x, const double y)
            {
              Coordinates p = times(side, axes[a]);
              p = add_scaled(p, 2. * x - 1., axes[(a + 1) % 3]);
              p = add_scaled(p, 2. * y - 1., axes[(a + 2) % 3]);
              return times(radius / norm(p), p);
            },
            {}, 0., random);
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
      for (const unsigned int node : surface.faces[f])
        surface.outward[f] = add_scaled(surface.outward[f], 1., surface.points[node]);
    return surface;
  }
} // namespace contact_meshes

#endif
