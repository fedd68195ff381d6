// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/element_vectors.h"

#include <taut/cable/cable_elements.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut
{
  CableElements::CableElements(const CableElement element, const double length,
                               const unsigned int n_elements, const CableSection &section)
      : kind(element), n(n_elements), h(length / n_elements), shortest(h), material(section)
  {
    ratios.length.assign(n + 1 + ElementBatch::size, 1.);
    ratios.of_position = ratios.of_middle = ratios.length;
    set_points();
  }

  CableElements::CableElements(const CableElement element, const std::vector<double> &places,
                               const CableSection &section)
      : CableElements(element, places.back(), places.size() - 1, section)
  {
    nodes = places;
    for (unsigned int e = 0; e < n; ++e)
    {
      const double length = nodes[e + 1] - nodes[e];
      shortest = std::min(shortest, length);
      ratios.length[e] = length / h;
      ratios.of_position[e] = h / length;
      ratios.of_middle[e] = kind == CableElement::bar ? h / length : 1.;
    }
  }

  void CableElements::set_points()
  {
    const auto points = [&](const dealii::Quadrature<1> &quadrature)
    {
      std::vector<Point> result;
      for (unsigned int k = 0; k < quadrature.size(); ++k)
      {
        const double xi = quadrature.point(k)[0];
        const Shapes shape = shapes(xi);
        result.push_back({h * quadrature.weight(k), xi, shape.slope, shape.curvature});
      }
      return result;
    };
    if (kind == CableElement::bar)
    {
      material.bending_stiffness = 0.;
      axial_points = inner_axial_points = points(dealii::QGauss<1>(2));
      return;
    }
    axial_points = points(dealii::QGaussLobatto<1>(3));
    inner_axial_points = {axial_points[1]};
    end_weight = axial_points[0].weight;
    if (material.bending_stiffness != 0.)
      bending_points = points(dealii::QGauss<1>(3));
  }

  std::vector<unsigned int> CableElements::unused_dofs() const
  {
    if (kind == CableElement::ancf)
      return {};
    return {dofs_per_node * n + 3, dofs_per_node * n + 4, dofs_per_node * n + 5};
  }

  std::array<unsigned int, 3> CableElements::end_dofs(const bool last) const
  {
    const unsigned int first = last ? dofs_per_node * n : 0;
    return {{first, first + 1, first + 2}};
  }

  CableElements CableElements::with_section(const CableSection &section) const
  {
    return nodes.empty() ? CableElements(kind, length(), n, section)
                         : CableElements(kind, nodes, section);
  }

  CableElements CableElements::with_axial_stiffness(const double EA) const
  {
    CableElements other = *this;
    other.material.axial_stiffness = EA;
    return other;
  }

  CableElements::Shapes CableElements::shapes(const double xi) const
  {
    const double eta = 1. - xi;
    if (kind == CableElement::bar) // first node, middle, second node
      return {{{eta * (eta - xi), 4. * xi * eta, xi * (xi - eta), 0.}},
              {{(xi - 3. * eta) / h, 4. * (eta - xi) / h, (3. * xi - eta) / h, 0.}},
              {{4. / (h * h), -8. / (h * h), 4. / (h * h), 0.}}};
    // Value and slope of the first node, then of the second node.
    return {{{eta * eta * (1. + 2. * xi), h * xi * eta * eta, xi * xi * (1. + 2. * eta),
              -h * xi * xi * eta}},
            {{-6. * xi * eta / h, eta * (1. - 3. * xi), 6. * xi * eta / h, xi * (1. - 3. * eta)}},
            {{6. * (xi - eta) / (h * h), (6. * xi - 4.) / h, 6. * (eta - xi) / (h * h),
              (6. * xi - 2.) / h}}};
  }

  /// Those of one element; shapes(xi) are those of an element of mean length.
  CableElements::Shapes CableElements::shapes(const double xi, const unsigned int e) const
  {
    Shapes result = shapes(xi);
    const Point scaled = in_element({0., xi, result.slope, result.curvature}, e);
    result.slope = scaled.slope;
    result.curvature = scaled.curvature;
    if (kind == CableElement::ancf)
      for (const unsigned int a : {1, 3})
        result.value[a] *= ratios.length[e];
    return result;
  }

  CableElements::Point CableElements::in_element(const Point &p, const unsigned int e) const
  {
    Point result = p;
    result.weight *= ratios.length[e];
    for (unsigned int a = 0; a < 4; ++a)
    {
      const double own = a % 2 == 0 ? ratios.of_position[e] : ratios.of_middle[e];
      result.slope[a] *= own;
      result.curvature[a] *= own * ratios.of_position[e];
    }
    return result;
  }

  /// The DoFs of an element, with positions relative to its first node: small differences of large
  /// numbers are taken once.
  CableElements::Local CableElements::local(const std::vector<double> &q,
                                            const unsigned int e) const
  {
    Local x;
    std::copy_n(q.begin() + dofs_per_node * e, element_dofs, x.begin());
    const std::array<double, 3> origin = {{x[0], x[1], x[2]}};
    for (const unsigned int a : {0, 2})
      for (unsigned int c = 0; c < 3; ++c)
        x[3 * a + c] -= origin[c];
    if (kind == CableElement::bar)
      for (unsigned int c = 0; c < 3; ++c)
        x[3 + c] -= origin[c];
    return x;
  }

  void CableElements::add_load(const Coordinates &force, std::vector<double> &f) const
  {
    const dealii::QGauss<1> quadrature(2); // exact
    for (unsigned int e = 0; e < n; ++e)
    {
      Local sum{};
      for (unsigned int k = 0; k < quadrature.size(); ++k)
        distribute(
            shapes(quadrature.point(k)[0], e).value,
            h * ratios.length[e] * quadrature.weight(k) * Vector({force.x, force.y, force.z}), sum);
      for (unsigned int i = 0; i < element_dofs; ++i)
        f[dofs_per_node * e + i] += sum[i];
    }
  }

  double CableElements::place(const double count) const
  {
    if (nodes.empty())
      return h * count;
    const unsigned int e = std::min(static_cast<unsigned int>(count), n - 1);
    return count == n ? nodes[n] : nodes[e] + (count - e) * (nodes[e + 1] - nodes[e]);
  }

  /// The element that contains s, and xi of s.
  std::pair<unsigned int, double> CableElements::find(const double s) const
  {
    if (!nodes.empty())
    {
      const auto after = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, s);
      const unsigned int e = after - nodes.begin() - 1;
      return {e, std::clamp((s - nodes[e]) / (nodes[e + 1] - nodes[e]), 0., 1.)};
    }
    const double place = std::clamp(s / h, 0., double(n));
    const unsigned int e = std::min(static_cast<unsigned int>(place), n - 1);
    return {e, place - e};
  }

  LinearForm CableElements::form(const double s, const Coordinates &direction,
                                 const bool slope) const
  {
    const auto [e, xi] = find(s);
    const Shapes all = shapes(xi, e);
    const Shape &shape = slope ? all.slope : all.value;
    LinearForm result;
    result.index.reserve(element_dofs);
    result.value.reserve(element_dofs);
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        if (const double value = shape[a] * direction[c]; value != 0.)
          result.add(dofs_per_node * e + 3 * a + c, value);
    return result;
  }

  LinearForm CableElements::position(const double s, const Coordinates &direction) const
  {
    return form(s, direction, false);
  }

  LinearForm CableElements::tangent(const double s, const Coordinates &direction) const
  {
    return form(s, direction, true);
  }

  Coordinates CableElements::vector(const std::vector<double> &q, const double s,
                                    const bool slope) const
  {
    const auto [e, xi] = find(s);
    const Shapes all = shapes(xi, e);
    Local x;
    std::copy_n(q.begin() + dofs_per_node * e, element_dofs, x.begin());
    const Vector r = combine(slope ? all.slope : all.value, x);
    return {r[0], r[1], r[2]};
  }

  Coordinates CableElements::position(const std::vector<double> &q, const double s) const
  {
    return vector(q, s, false);
  }

  Coordinates CableElements::tangent(const std::vector<double> &q, const double s) const
  {
    return vector(q, s, true);
  }

  double CableElements::tension(const std::vector<double> &q, const double s) const
  {
    const auto [e, xi] = find(s);
    const Local x = local(q, e);
    double tension = 0.;
    for (const Point &p : axial_points)
    {
      double weight = 1.; // Lagrange polynomial of this point
      for (const Point &other : axial_points)
        if (&other != &p)
          weight *= (xi - other.xi) / (p.xi - other.xi);
      tension +=
          weight * material.axial_stiffness * (combine(in_element(p, e).slope, x).norm() - 1.);
    }
    return tension;
  }

  double CableElements::largest_strain(const std::vector<double> &q) const
  {
    double strain = -1.;
    for (unsigned int e = 0; e < n; ++e)
      for (const Point &p : axial_points)
        strain = std::max(strain, combine(in_element(p, e).slope, local(q, e)).norm() - 1.);
    return strain;
  }

  double CableElements::curvature(const std::vector<double> &q, const double s) const
  {
    if (kind == CableElement::bar)
      return 0.;
    const auto [e, xi] = find(s);
    const Shapes all = shapes(xi, e);
    const Local x = local(q, e);
    const Vector u = combine(all.slope, x), v = combine(all.curvature, x);
    return dealii::cross_product_3d(u, v).norm() / u.norm_square();
  }
} // namespace taut
