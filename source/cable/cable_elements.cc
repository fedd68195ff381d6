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
    /// |r'|; its arguments are no infinities.
    double stretch_of(const Coordinates &u)
    {
      return std::sqrt(dot(u, u));
    }

    double curvature_squared(const Coordinates &u, const Coordinates &v)
    {
      const Coordinates w = cross_product(u, v);
      const double a = dot(u, u);
      return dot(w, w) / (a * a);
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

  /// Elements from @p first on; after the last node to and fro, so that no element lacks a length.
  inline ElementBatch CableElements::batch(const std::vector<double> &q,
                                           const unsigned int first) const
  {
    double node[dofs_per_node][ElementBatch::size + 1];
    for (unsigned int l = 0; l <= ElementBatch::size; ++l)
    {
      const unsigned int k = first + l;
      const double *const own = q.data() + dofs_per_node * (k <= n ? k : n - (k - n) % 2);
      for (unsigned int i = 0; i < dofs_per_node; ++i)
        node[i][l] = own[i];
    }
    ElementBatch x;
    for (unsigned int i = 0; i < dofs_per_node; ++i)
    {
      std::copy_n(node[i], ElementBatch::size, x.dof[i].begin());
      std::copy_n(node[i] + 1, ElementBatch::size, x.dof[dofs_per_node + i].begin());
    }
    const auto subtract_origin = [&x](const unsigned int a)
    {
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int l = 0; l < ElementBatch::size; ++l)
          x.dof[3 * a + c][l] -= x.dof[c][l];
    };
    if (kind == CableElement::bar)
      subtract_origin(1);
    subtract_origin(2);
    subtract_origin(0);
    return x;
  }

  double CableElements::strain_energy(const std::vector<double> &q) const
  {
    double energy = 0.;
    vectorised(
        [this, &q, &energy]
        {
          double all = 0.;
          for (unsigned int first = 0; first < n; first += ElementBatch::size)
          {
            const ElementBatch x = batch(q, first);
            std::array<double, ElementBatch::size> sum{};
            for (const Point &p : axial_points)
#pragma omp simd
              for (unsigned int l = 0; l < ElementBatch::size; ++l)
              {
                const double strain = stretch_of(combine(p.slope, x, l)) - 1.;
                sum[l] += .5 * p.weight * material.axial_stiffness * strain * strain;
              }
            for (const Point &p : bending_points)
#pragma omp simd
              for (unsigned int l = 0; l < ElementBatch::size; ++l)
                sum[l] += .5 * p.weight * material.bending_stiffness *
                          curvature_squared(combine(p.slope, x, l), combine(p.curvature, x, l));
            for (unsigned int l = 0; l < std::min(n - first, ElementBatch::size); ++l)
              all += sum[l];
          }
          energy = all;
        });
    return energy;
  }

  /// f = the sum of what @p integrand (first element of a batch, its forces) adds.
  template <typename Integrand>
  void CableElements::integrate_force(std::vector<double> &f, const Integrand &integrand) const
  {
    f.assign(n_dofs(), 0.);
    vectorised(
        [this, &integrand, all = f.data()]
        {
          for (unsigned int first = 0; first < n; first += ElementBatch::size)
          {
            ElementBatch sum;
            integrand(first, sum);
            for (unsigned int l = 0; l < std::min(n - first, ElementBatch::size); ++l)
              for (unsigned int i = 0; i < element_dofs; ++i)
                all[dofs_per_node * (first + l) + i] += sum.dof[i][l];
          }
        });
  }

  void CableElements::internal_force(const std::vector<double> &q,
                                     const std::vector<double> &velocity,
                                     std::vector<double> &f) const
  {
    const bool damped = !velocity.empty() && material.axial_damping != 0.;
    const double damping = damped ? material.axial_damping : 0.;
    const auto integrand = [&](const unsigned int first, ElementBatch &sum)
    {
      const ElementBatch x = batch(q, first),
                         rate = damped ? batch(velocity, first) : ElementBatch();
      for (const Point &p : axial_points)
#pragma omp simd
        for (unsigned int l = 0; l < ElementBatch::size; ++l)
        {
          const Coordinates u = combine(p.slope, x, l);
          const double stretch = stretch_of(u);
          const double force = material.axial_stiffness * (stretch - 1.) +
                               damping * dot(u, combine(p.slope, rate, l)) / stretch;
          distribute(p.slope, (p.weight * force / stretch) * u, sum, l);
        }
      for (const Point &p : bending_points)
#pragma omp simd
        for (unsigned int l = 0; l < ElementBatch::size; ++l)
        {
          // kappa^2 = |w|^2 / a^2 with w = u x v and a = u . u
          const Coordinates u = combine(p.slope, x, l), v = combine(p.curvature, x, l),
                            w = cross_product(u, v);
          const double a = dot(u, u), factor = p.weight * material.bending_stiffness / (a * a);
          distribute(p.slope, factor * (cross_product(v, w) + (-2. * dot(w, w) / a) * u), sum, l);
          distribute(p.curvature, factor * cross_product(w, u), sum, l);
        }
    };
    integrate_force(f, integrand);
  }

  void CableElements::mean_force(const std::vector<double> &q0, const std::vector<double> &q1,
                                 const double step, std::vector<double> &f) const
  {
    const double damping = material.axial_damping == 0. ? 0. : material.axial_damping / step;
    const auto integrand = [&](const unsigned int first, ElementBatch &sum)
    {
      const ElementBatch x0 = batch(q0, first), x1 = batch(q1, first);
      for (const Point &p : axial_points)
#pragma omp simd
        for (unsigned int l = 0; l < ElementBatch::size; ++l)
        {
          const Coordinates u0 = combine(p.slope, x0, l), u1 = combine(p.slope, x1, l);
          const double stretch0 = stretch_of(u0), stretch1 = stretch_of(u1),
                       twice = stretch0 + stretch1;
          const double force =
              material.axial_stiffness * (.5 * twice - 1.) + damping * (stretch1 - stretch0);
          distribute(p.slope, (p.weight * force / twice) * (u0 + u1), sum, l);
        }
      for (const Point &p : bending_points)
#pragma omp simd
        for (unsigned int l = 0; l < ElementBatch::size; ++l)
        {
          // kappa^2 = c A - (b A)^2 with a = u . u, b = u . v, c = v . v and A = 1 / a:
          // differences of products, with means of the factors.
          const Coordinates u0 = combine(p.slope, x0, l), u1 = combine(p.slope, x1, l),
                            v0 = combine(p.curvature, x0, l), v1 = combine(p.curvature, x1, l);
          const Coordinates u = .5 * (u0 + u1), v = .5 * (v0 + v1);
          const double A0 = 1. / dot(u0, u0), A1 = 1. / dot(u1, u1), b0 = dot(u0, v0),
                       b1 = dot(u1, v1), A = .5 * (A0 + A1), b = .5 * (b0 + b1),
                       c = .5 * (dot(v0, v0) + dot(v1, v1)), bA = .5 * (b0 * A0 + b1 * A1);
          const double by_a = (2. * b * bA - c) * A0 * A1, by_b = -2. * bA * A, by_c = A;
          const double factor = .5 * p.weight * material.bending_stiffness;
          distribute(p.slope, factor * ((2. * by_a) * u + by_b * v), sum, l);
          distribute(p.curvature, factor * (by_b * u + (2. * by_c) * v), sum, l);
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

  double CableElements::smallest_strain(const std::vector<double> &q, double *const place) const
  {
    double least = std::numeric_limits<double>::max(), found = 0.;
    vectorised(
        [this, &q, all_least = &least, all_found = &found]
        {
          double smallest = *all_least, where = 0.;
          for (unsigned int first = 0; first < n; first += ElementBatch::size)
          {
            const ElementBatch x = batch(q, first);
            for (const Point &p : axial_points)
            {
              double stretch[ElementBatch::size];
#pragma omp simd
              for (unsigned int l = 0; l < ElementBatch::size; ++l)
                stretch[l] = stretch_of(combine(p.slope, x, l));
              const double *const shortest =
                  std::min_element(stretch, stretch + std::min(n - first, ElementBatch::size));
              if (!(*shortest < smallest))
                continue;
              smallest = *shortest;
              where = h * (first + (shortest - stretch) + p.xi);
            }
          }
          *all_least = smallest;
          *all_found = where;
        });
    if (place)
      *place = found;
    return least - 1.;
  }

  double CableElements::curvature(const std::vector<double> &q, const double s) const
  {
    if (kind == CableElement::bar)
      return 0.;
    const auto [e, xi] = find(s);
    const Shapes all = shapes(xi);
    const Local x = local(q, e);
    const Vector u = combine(all.slope, x), v = combine(all.curvature, x);
    return std::sqrt(curvature_squared({u[0], u[1], u[2]}, {v[0], v[1], v[2]}));
  }
} // namespace taut
