// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/element_vectors.h"

#include "base/instruction_set.h"
#include <taut/cable/cable_elements.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    using dealii::cross_product_3d;
    using dealii::outer_product;

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

    /// Blocks (a, b) += slope[a] (uu slope[b] + uv curvature[b]) + curvature[a] (uv^T slope[b] + vv
    /// curvature[b]); only blocks with a >= b, as the others follow from symmetry.
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
  } // namespace

  void CableElements::add_axial_tangent(const Local &x, const unsigned int e, const bool definite,
                                        LocalMatrix &K) const
  {
    for (const Point &of_mean : axial_points)
    {
      const Point p = in_element(of_mean, e);
      const Vector u = combine(p.slope, x);
      const double stretch = u.norm();
      const double geometric = material.axial_stiffness * (stretch - 1.) / stretch,
                   kept = definite ? std::max(geometric, 0.) : geometric;
      const Matrix along = outer_product(u, u) / (stretch * stretch);
      distribute(p.slope, p.weight * (material.axial_stiffness * along + kept * (identity - along)),
                 K);
    }
  }

  void CableElements::add_bending_tangent(const Local &x, const unsigned int e, const bool definite,
                                          LocalMatrix &K) const
  {
    for (const Point &of_mean : bending_points)
    {
      const Point p = in_element(of_mean, e);
      const Vector u = combine(p.slope, x), v = combine(p.curvature, x);
      const double a = u.norm_square();
      Matrix uu, uv, vv;
      if (definite)
      {
        // The semidefinite part: the square of the gradient of the vector k = u x v / a alone.
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
            add_axial_tangent(x, e, definite, K);
            add_bending_tangent(x, e, definite, K);
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
      for (const Point &of_mean : axial_points)
      {
        const Point p = in_element(of_mean, e);
        const Vector u = combine(p.slope, x);
        const double end = combine(p.slope, x1).norm(), sum = combine(p.slope, x0).norm() + end;
        const double geometric = material.axial_stiffness * (1. - 2. / sum),
                     along = 4. * material.axial_stiffness / (sum * sum * end);
        distribute(p.slope,
                   p.weight * (along * outer_product(u, u) +
                               (definite ? std::max(geometric, 0.) : geometric) * identity),
                   K);
      }
      add_bending_tangent(x, e, definite, K);
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
      for (const Point &of_mean : axial_points)
      {
        const Point p = in_element(of_mean, e);
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
    const dealii::QGauss<1> quadrature(4); // exact
    for (unsigned int e = 0; e < n; ++e)
    {
      LocalMatrix K{};
      const double mass = factor * material.mass_per_length * (h * ratios.length[e]);
      for (unsigned int k = 0; k < quadrature.size(); ++k)
        distribute(shapes(quadrature.point(k)[0], e).value, mass * quadrature.weight(k) * identity,
                   K);
      add(K, e, A);
    }
  }
} // namespace taut
