// SPDX-License-Identifier: LGPL-2.1-or-later
#include "element_vectors.h"

#include <taut/base/instruction_set.h>
#include <taut/cable/cable_elements.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace taut
{
  namespace
  {
    /// The vector a of an element += shape[a] g.
    template <typename Local>
    void distribute(const std::array<double, 4> &shape, const Vector &g, Local &f)
    {
      for (unsigned int a = 0; a < 4; ++a)
        for (unsigned int c = 0; c < 3; ++c)
          f[3 * a + c] += shape[a] * g[c];
    }

    double curvature_squared(const Vector &u, const Vector &v)
    {
      return cross_product_3d(u, v).norm_square() / std::pow(u.norm_square(), 2);
    }
  } // namespace

  CableElements::CableElements(const CableElement element, const double length,
                               const unsigned int n_elements, const CableSection &section)
      : kind(element), n(n_elements), h(length / n_elements), material(section)
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
      axial_points = points(dealii::QGauss<1>(2));
      return;
    }
    axial_points = points(dealii::QGaussLobatto<1>(3));
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
    // Value and slope of the first node, of the second one.
    return {{{eta * eta * (1. + 2. * xi), h * xi * eta * eta, xi * xi * (1. + 2. * eta),
              -h * xi * xi * eta}},
            {{-6. * xi * eta / h, eta * (1. - 3. * xi), 6. * xi * eta / h, xi * (1. - 3. * eta)}},
            {{6. * (xi - eta) / (h * h), (6. * xi - 4.) / h, 6. * (eta - xi) / (h * h),
              (6. * xi - 2.) / h}}};
  }

  /// Its DoFs, with positions from its first node: small differences of large numbers are taken
  /// once.
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

  double CableElements::strain_energy(const std::vector<double> &q) const
  {
    double energy = 0.;
    for (unsigned int e = 0; e < n; ++e)
    {
      const Local x = local(q, e);
      for (const Point &p : axial_points)
        energy +=
            .5 * p.weight * material.axial_stiffness * std::pow(combine(p.slope, x).norm() - 1., 2);
      for (const Point &p : bending_points)
        energy += .5 * p.weight * material.bending_stiffness *
                  curvature_squared(combine(p.slope, x), combine(p.curvature, x));
    }
    return energy;
  }

  /// f = the sum of what @p integrand (element, its force) adds.
  template <typename Integrand>
  void CableElements::integrate_force(std::vector<double> &f, const Integrand &integrand) const
  {
    f.assign(n_dofs(), 0.);
    vectorised(
        [this, &integrand, all = f.data()]
        {
          for (unsigned int e = 0; e < n; ++e)
          {
            Local sum{};
            integrand(e, sum);
            for (unsigned int i = 0; i < element_dofs; ++i)
              all[dofs_per_node * e + i] += sum[i];
          }
        });
  }

  void CableElements::internal_force(const std::vector<double> &q,
                                     const std::vector<double> &velocity,
                                     std::vector<double> &f) const
  {
    const bool damped = !velocity.empty() && material.axial_damping != 0.;
    const auto integrand = [&](const unsigned int e, Local &sum)
    {
      const Local x = local(q, e);
      const Local rate = damped ? local(velocity, e) : Local{};
      for (const Point &p : axial_points)
      {
        const Vector u = combine(p.slope, x);
        const double stretch = u.norm();
        double force = material.axial_stiffness * (stretch - 1.);
        if (damped)
          force += material.axial_damping * (u * combine(p.slope, rate)) / stretch;
        distribute(p.slope, p.weight * force / stretch * u, sum);
      }
      for (const Point &p : bending_points)
      {
        // kappa^2 = |w|^2 / a^2 with w = u x v and a = u . u
        const Vector u = combine(p.slope, x), v = combine(p.curvature, x),
                     w = cross_product_3d(u, v);
        const double a = u.norm_square(), factor = p.weight * material.bending_stiffness / (a * a);
        distribute(p.slope, factor * (cross_product_3d(v, w) - 2. * w.norm_square() / a * u), sum);
        distribute(p.curvature, factor * cross_product_3d(w, u), sum);
      }
    };
    integrate_force(f, integrand);
  }

  void CableElements::mean_force(const std::vector<double> &q0, const std::vector<double> &q1,
                                 const double step, std::vector<double> &f) const
  {
    const auto integrand = [&](const unsigned int e, Local &sum)
    {
      const Local x0 = local(q0, e), x1 = local(q1, e);
      for (const Point &p : axial_points)
      {
        const Vector u0 = combine(p.slope, x0), u1 = combine(p.slope, x1);
        const double stretch0 = u0.norm(), stretch1 = u1.norm(), twice = stretch0 + stretch1;
        const double force =
            material.axial_stiffness * (.5 * twice - 1.) +
            (material.axial_damping == 0. ? 0.
                                          : material.axial_damping * (stretch1 - stretch0) / step);
        distribute(p.slope, p.weight * force / twice * (u0 + u1), sum);
      }
      for (const Point &p : bending_points)
      {
        // kappa^2 = c A - (b A)^2 with a = u . u, b = u . v, c = v . v and A = 1 / a:
        // differences of products, with means of the factors.
        const Vector u0 = combine(p.slope, x0), u1 = combine(p.slope, x1),
                     v0 = combine(p.curvature, x0), v1 = combine(p.curvature, x1);
        const Vector u = .5 * (u0 + u1), v = .5 * (v0 + v1);
        const double A0 = 1. / u0.norm_square(), A1 = 1. / u1.norm_square(), b0 = u0 * v0,
                     b1 = u1 * v1, A = .5 * (A0 + A1), b = .5 * (b0 + b1),
                     c = .5 * (v0.norm_square() + v1.norm_square()), bA = .5 * (b0 * A0 + b1 * A1);
        const double by_a = (2. * b * bA - c) * A0 * A1, by_b = -2. * bA * A, by_c = A;
        const double factor = .5 * p.weight * material.bending_stiffness;
        distribute(p.slope, factor * (2. * by_a * u + by_b * v), sum);
        distribute(p.curvature, factor * (by_b * u + 2. * by_c * v), sum);
      }
    };
    integrate_force(f, integrand);
  }

  void CableElements::add_load(const Coordinates &force, std::vector<double> &f) const
  {
    Local sum{};
    const dealii::QGauss<1> quadrature(2); // exact
    for (unsigned int k = 0; k < quadrature.size(); ++k)
      distribute(shapes(quadrature.point(k)[0]).value,
                 h * quadrature.weight(k) * Vector({force.x, force.y, force.z}), sum);
    for (unsigned int e = 0; e < n; ++e)
      for (unsigned int i = 0; i < element_dofs; ++i)
        f[dofs_per_node * e + i] += sum[i];
  }

  /// The element with s, and xi there.
  std::pair<unsigned int, double> CableElements::find(const double s) const
  {
    const double place = std::clamp(s / h, 0., double(n));
    const unsigned int e = std::min(static_cast<unsigned int>(place), n - 1);
    return {e, place - e};
  }

  LinearForm CableElements::form(const double s, const Coordinates &direction,
                                 const bool slope) const
  {
    const auto [e, xi] = find(s);
    const Shapes all = shapes(xi);
    const Shape &shape = slope ? all.slope : all.value;
    LinearForm result;
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
    const Shapes all = shapes(xi);
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
      tension += weight * material.axial_stiffness * (combine(p.slope, x).norm() - 1.);
    }
    return tension;
  }

  double CableElements::largest_strain(const std::vector<double> &q) const
  {
    double strain = -1.;
    for (unsigned int e = 0; e < n; ++e)
      for (const Point &p : axial_points)
        strain = std::max(strain, combine(p.slope, local(q, e)).norm() - 1.);
    return strain;
  }

  double CableElements::smallest_strain(const std::vector<double> &q) const
  {
    double strain = std::numeric_limits<double>::max();
    for (unsigned int e = 0; e < n; ++e)
      for (const Point &p : axial_points)
        strain = std::min(strain, combine(p.slope, local(q, e)).norm() - 1.);
    return strain;
  }

  double CableElements::curvature(const std::vector<double> &q, const double s) const
  {
    if (kind == CableElement::bar)
      return 0.;
    const auto [e, xi] = find(s);
    const Shapes all = shapes(xi);
    const Local x = local(q, e);
    return std::sqrt(curvature_squared(combine(all.slope, x), combine(all.curvature, x)));
  }
} // namespace taut
