// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/instruction_set.h>
#include <taut/cable/cable_elements.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace taut
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;
    using Matrix = dealii::Tensor<2, 3>;
    using dealii::cross_product_3d;
    using dealii::outer_product;

    /// sum of shape[a] times the vector a of an element.
    template <typename Local>
    Vector combine(const std::array<double, 4> &shape, const Local &x)
    {
      Vector r;
      for (unsigned int a = 0; a < 4; ++a)
        for (unsigned int c = 0; c < 3; ++c)
          r[c] += shape[a] * x[3 * a + c];
      return r;
    }

    /// The vector a of an element += shape[a] g.
    template <typename Local>
    void distribute(const std::array<double, 4> &shape, const Vector &g, Local &f)
    {
      for (unsigned int a = 0; a < 4; ++a)
        for (unsigned int c = 0; c < 3; ++c)
          f[3 * a + c] += shape[a] * g[c];
    }

    /// Blocks (a, b) += slope[a] (uu slope[b] + uv curvature[b]) + curvature[a] (uv^T slope[b] + vv
    /// curvature[b]); only those with a >= b, as the rest follows from symmetry.
    template <typename LocalMatrix>
    void distribute(const std::array<double, 4> &slope, const std::array<double, 4> &curvature,
                    const Matrix &uu, const Matrix &uv, const Matrix &vv, LocalMatrix &K)
    {
      for (unsigned int b = 0; b < 4; ++b)
      {
        const Matrix by_slope = slope[b] * uu + curvature[b] * uv,
                     by_curvature = slope[b] * transpose(uv) + curvature[b] * vv;
        for (unsigned int a = b; a < 4; ++a)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              K[3 * a + c][3 * b + d] +=
                  slope[a] * by_slope[c][d] + curvature[a] * by_curvature[c][d];
      }
    }

    /// Blocks (a, b) += shape[a] H shape[b], with a >= b.
    template <typename LocalMatrix>
    void distribute(const std::array<double, 4> &shape, const Matrix &H, LocalMatrix &K)
    {
      for (unsigned int b = 0; b < 4; ++b)
      {
        const Matrix column = shape[b] * H;
        for (unsigned int a = b; a < 4; ++a)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              K[3 * a + c][3 * b + d] += shape[a] * column[c][d];
      }
    }

    const Matrix identity(dealii::unit_symmetric_tensor<3>());

    /// [u]: [u] v = u x v.
    Matrix cross_matrix(const Vector &u)
    {
      Matrix S;
      S[0][1] = -u[2];
      S[0][2] = u[1];
      S[1][0] = u[2];
      S[1][2] = -u[0];
      S[2][0] = -u[1];
      S[2][1] = u[0];
      return S;
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

  void CableElements::add_axial_tangent(const Local &x, const bool definite, LocalMatrix &K) const
  {
    for (const Point &p : axial_points)
    {
      const Vector u = combine(p.slope, x);
      const double stretch = u.norm();
      const double geometric = material.axial_stiffness * (stretch - 1.) / stretch,
                   kept = definite ? std::max(geometric, 0.) : geometric;
      const Matrix along = outer_product(u, u) / (stretch * stretch);
      distribute(p.slope, p.weight * (material.axial_stiffness * along + kept * (identity - along)),
                 K);
    }
  }

  void CableElements::add_bending_tangent(const Local &x, const bool definite, LocalMatrix &K) const
  {
    for (const Point &p : bending_points)
    {
      const Vector u = combine(p.slope, x), v = combine(p.curvature, x);
      const double a = u.norm_square();
      Matrix uu, uv, vv;
      if (definite)
      {
        // That of a vector k = u x v / a with a gradient that is kept: its square alone.
        const Vector k = cross_product_3d(u, v) / a;
        const Matrix by_u = (-1. / a) * (cross_matrix(v) + 2. * outer_product(k, u)),
                     by_v = cross_matrix(u) / a;
        uu = transpose(by_u) * by_u;
        uv = transpose(by_u) * by_v;
        vv = transpose(by_v) * by_v;
      }
      else
      {
        // Chain rule on G(a, b, c) = (c / a - (b / a)^2) / 2, a = u . u, b = u . v, c = v . v.
        const double b = u * v, c = v.norm_square(), B = b / a;
        const double G_a = (B * B - .5 * c / a) / a, G_b = -B / a, G_c = .5 / a,
                     G_aa = (c / a - 3. * B * B) / (a * a), G_ab = 2. * B / (a * a),
                     G_bb = -1. / (a * a), G_ac = -.5 / (a * a);
        const Matrix u_u = outer_product(u, u), u_v = outer_product(u, v);
        uu = 4. * G_aa * u_u + 2. * G_ab * (u_v + transpose(u_v)) + G_bb * outer_product(v, v) +
             2. * G_a * identity;
        uv = 2. * G_ab * u_u + G_bb * transpose(u_v) + 4. * G_ac * u_v + G_b * identity;
        vv = G_bb * u_u + 2. * G_c * identity;
      }
      const double factor = p.weight * material.bending_stiffness;
      distribute(p.slope, p.curvature, factor * uu, factor * uv, factor * vv, K);
    }
  }

  void CableElements::add(const LocalMatrix &K, const unsigned int e, SymmetricMatrix &A) const
  {
    const unsigned int first = dofs_per_node * e, n_own = kind == CableElement::ancf ? 12 : 9;
    for (unsigned int i = 0; i < n_own; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        A.add(first + i, first + j, K[i][j]);
  }

  void CableElements::add_tangent(const std::vector<double> &q, const bool definite,
                                  SymmetricMatrix &A) const
  {
    vectorised(
        [this, &q, definite, &A]
        {
          for (unsigned int e = 0; e < n; ++e)
          {
            const Local x = local(q, e);
            LocalMatrix K{};
            add_axial_tangent(x, definite, K);
            add_bending_tangent(x, definite, K);
            add(K, e, A);
          }
        });
  }

  void CableElements::add_mean_tangent(const std::vector<double> &q0, const std::vector<double> &q1,
                                       const bool definite, SymmetricMatrix &A) const
  {
    for (unsigned int e = 0; e < n; ++e)
    {
      const Local x0 = local(q0, e), x1 = local(q1, e);
      Local x;
      for (unsigned int i = 0; i < element_dofs; ++i)
        x[i] = .5 * (x0[i] + x1[i]);
      LocalMatrix K{};
      for (const Point &p : axial_points)
      {
        const Vector u = combine(p.slope, x);
        const double end = combine(p.slope, x1).norm(), sum = combine(p.slope, x0).norm() + end;
        const double geometric = material.axial_stiffness * (1. - 2. / sum),
                     along = 4. * material.axial_stiffness / (sum * sum * end);
        distribute(p.slope,
                   p.weight * (along * outer_product(u, u) +
                               (definite ? std::max(geometric, 0.) : geometric) * identity),
                   K);
      }
      add_bending_tangent(x, definite, K);
      add(K, e, A);
    }
  }

  void CableElements::add_damping(const std::vector<double> &q, const double factor,
                                  SymmetricMatrix &A) const
  {
    if (material.axial_damping == 0. || factor == 0.)
      return;
    for (unsigned int e = 0; e < n; ++e)
    {
      const Local x = local(q, e);
      LocalMatrix K{};
      for (const Point &p : axial_points)
      {
        const Vector u = combine(p.slope, x);
        distribute(
            p.slope,
            p.weight * factor * material.axial_damping / u.norm_square() * outer_product(u, u), K);
      }
      add(K, e, A);
    }
  }

  void CableElements::add_mass(const double factor, SymmetricMatrix &A) const
  {
    LocalMatrix K{};
    const dealii::QGauss<1> quadrature(4); // exact
    for (unsigned int k = 0; k < quadrature.size(); ++k)
    {
      const Shape value = shapes(quadrature.point(k)[0]).value;
      distribute(value, factor * material.mass_per_length * h * quadrature.weight(k) * identity, K);
    }
    for (unsigned int e = 0; e < n; ++e)
      add(K, e, A);
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
