// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/face_shapes.h"

#include <cmath>

namespace taut
{
  namespace
  {
    /// Lagrange polynomials on [0, 1] with equidistant nodes in ascending order.
    struct Polynomials
    {
      std::array<double, 3> value{}, first{}, second{};
    };

    Polynomials lagrange(const unsigned int degree, const double t)
    {
      Polynomials p;
      if (degree == 1)
      {
        p.value = {1. - t, t, 0.};
        p.first = {-1., 1., 0.};
      }
      else
      {
        p.value = {(1. - t) * (1. - 2. * t), 4. * t * (1. - t), t * (2. * t - 1.)};
        p.first = {4. * t - 3., 4. - 8. * t, 4. * t - 1.};
        p.second = {4., -8., 4.};
      }
      return p;
    }

    FaceShapes line_shapes(const unsigned int degree, const double t)
    {
      const Polynomials p = lagrange(degree, t);
      FaceShapes s;
      s.n = degree + 1;
      for (unsigned int i = 0; i < s.n; ++i)
      {
        // Ends first, then the middle.
        const unsigned int k = i == 0 ? 0 : i == 1 ? degree : 1;
        s.value[i] = p.value[k];
        s.dx[i] = p.first[k];
        s.dxx[i] = p.second[k];
      }
      return s;
    }

    FaceShapes quadrilateral_shapes(const unsigned int degree, const ReferencePoint &at)
    {
      const Polynomials p = lagrange(degree, at.x), q = lagrange(degree, at.y);
      FaceShapes s;
      for (unsigned int j = 0; j <= degree; ++j)
        for (unsigned int i = 0; i <= degree; ++i, ++s.n)
        {
          s.value[s.n] = p.value[i] * q.value[j];
          s.dx[s.n] = p.first[i] * q.value[j];
          s.dy[s.n] = p.value[i] * q.first[j];
          s.dxx[s.n] = p.second[i] * q.value[j];
          s.dxy[s.n] = p.first[i] * q.first[j];
          s.dyy[s.n] = p.value[i] * q.second[j];
        }
      return s;
    }

    FaceShapes triangle_shapes(const unsigned int degree, const ReferencePoint &at)
    {
      const double l[3] = {1. - at.x - at.y, at.x, at.y};
      const double lx[3] = {-1., 1., 0.}, ly[3] = {-1., 0., 1.};
      FaceShapes s;
      s.n = degree == 1 ? 3 : 6;
      for (unsigned int i = 0; i < 3; ++i)
        if (degree == 1)
        {
          s.value[i] = l[i];
          s.dx[i] = lx[i];
          s.dy[i] = ly[i];
        }
        else
        {
          s.value[i] = l[i] * (2. * l[i] - 1.);
          s.dx[i] = (4. * l[i] - 1.) * lx[i];
          s.dy[i] = (4. * l[i] - 1.) * ly[i];
          s.dxx[i] = 4. * lx[i] * lx[i];
          s.dxy[i] = 4. * lx[i] * ly[i];
          s.dyy[i] = 4. * ly[i] * ly[i];
          const unsigned int j = (i + 1) % 3, m = 3 + i; // the middle of i and j
          s.value[m] = 4. * l[i] * l[j];
          s.dx[m] = 4. * (lx[i] * l[j] + l[i] * lx[j]);
          s.dy[m] = 4. * (ly[i] * l[j] + l[i] * ly[j]);
          s.dxx[m] = 8. * lx[i] * lx[j];
          s.dxy[m] = 4. * (lx[i] * ly[j] + ly[i] * lx[j]);
          s.dyy[m] = 8. * ly[i] * ly[j];
        }
      return s;
    }
  } // namespace

  FaceForm face_form(const unsigned int dim, const unsigned int degree, const std::size_t n_nodes)
  {
    if (degree != 1 && degree != 2)
      return FaceForm::none;
    if (dim == 2)
      return n_nodes == degree + 1 ? FaceForm::line : FaceForm::none;
    if (dim != 3)
      return FaceForm::none;
    if (n_nodes == (degree + 1) * (degree + 1))
      return FaceForm::quadrilateral;
    return n_nodes == (degree + 1) * (degree + 2) / 2 ? FaceForm::triangle : FaceForm::none;
  }

  FaceShapes face_shapes(const FaceForm form, const unsigned int degree, const ReferencePoint &at)
  {
    return form == FaceForm::line            ? line_shapes(degree, at.x)
           : form == FaceForm::quadrilateral ? quadrilateral_shapes(degree, at)
                                             : triangle_shapes(degree, at);
  }

  ReferencePoint centre(const FaceForm form)
  {
    return form == FaceForm::triangle ? ReferencePoint{1. / 3., 1. / 3.} : ReferencePoint{.5, .5};
  }

  const std::vector<FaceEdge> &face_edges(const FaceForm form, const unsigned int degree)
  {
    static const std::vector<FaceEdge> none,
        quadrilateral[2] = {{{{0., 0.}, {1., 0.}, 0, 1, 0},
                             {{1., 0.}, {1., 1.}, 1, 3, 0},
                             {{1., 1.}, {0., 1.}, 3, 2, 0},
                             {{0., 1.}, {0., 0.}, 2, 0, 0}},
                            {{{0., 0.}, {1., 0.}, 0, 2, 1},
                             {{1., 0.}, {1., 1.}, 2, 8, 5},
                             {{1., 1.}, {0., 1.}, 8, 6, 7},
                             {{0., 1.}, {0., 0.}, 6, 0, 3}}},
        triangle[2] = {{{{0., 0.}, {1., 0.}, 0, 1, 0},
                        {{1., 0.}, {0., 1.}, 1, 2, 0},
                        {{0., 1.}, {0., 0.}, 2, 0, 0}},
                       {{{0., 0.}, {1., 0.}, 0, 1, 3},
                        {{1., 0.}, {0., 1.}, 1, 2, 4},
                        {{0., 1.}, {0., 0.}, 2, 0, 5}}};
    return form == FaceForm::quadrilateral ? quadrilateral[degree - 1]
           : form == FaceForm::triangle    ? triangle[degree - 1]
                                           : none;
  }

  const std::array<std::pair<double, double>, 6> &gauss_points()
  {
    // Roots of the Legendre polynomial of degree 6, by Newton's method.
    static const std::array<std::pair<double, double>, 6> points = []()
    {
      constexpr unsigned int n = 6;
      std::array<std::pair<double, double>, n> result;
      for (unsigned int k = 0; k < n; ++k)
      {
        double x = -std::cos(std::acos(-1.) * (k + .75) / (n + .5)), slope = 1.;
        for (unsigned int iteration = 0; iteration < 20; ++iteration)
        {
          double p0 = 1., p1 = x;
          for (unsigned int i = 2; i <= n; ++i)
          {
            const double p2 = ((2. * i - 1.) * x * p1 - (i - 1.) * p0) / i;
            p0 = p1;
            p1 = p2;
          }
          slope = n * (x * p1 - p0) / (x * x - 1.);
          x -= p1 / slope;
        }
        result[k] = {.5 * (1. + x), 1. / ((1. - x * x) * slope * slope)};
      }
      return result;
    }();
    return points;
  }

  std::vector<QuadraturePoint> face_quadrature(const FaceForm form)
  {
    std::vector<QuadraturePoint> points;
    for (const auto &[x, weight_x] : gauss_points())
    {
      if (form == FaceForm::line)
      {
        points.push_back({{x, 0.}, weight_x});
        continue;
      }
      for (const auto &[y, weight_y] : gauss_points())
        if (form == FaceForm::quadrilateral)
          points.push_back({{x, y}, weight_x * weight_y});
        else // the square with one edge shrunk to a vertex
          points.push_back({{x, (1. - x) * y}, weight_x * weight_y * (1. - x)});
    }
    return points;
  }
} // namespace taut
