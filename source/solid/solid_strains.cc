// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/solid/elastic_solid.h>

#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  /**
   * The energy that lines of bilinear and trilinear cells store because they stay straight is what
   * the modes 1 - xi_k^2 would relax (R. L. Taylor, P. J. Beresford, E. L. Wilson, Int. J. Numer.
   * Meth. Engng 10 (1976)).
   */
  template <int dim>
  Straining ElasticSolid<dim>::straining(const std::vector<double> &U) const
  {
    const dealii::Vector<double> all = this->all_dofs(U);
    const bool may_lock = mesh->degree() == 1 && !mesh->is_simplicial();
    dealii::FEValues<dim> values(mesh->mapping(), mesh->dof_handler().get_fe(),
                                 mesh->quadrature(mesh->degree() + 1),
                                 dealii::update_gradients | dealii::update_JxW_values |
                                     dealii::update_quadrature_points | dealii::update_jacobians),
        middle(mesh->mapping(), mesh->dof_handler().get_fe(), mesh->quadrature(1),
               dealii::update_jacobians | dealii::update_inverse_jacobians);
    std::vector<dealii::SymmetricTensor<2, dim>> strains(values.n_quadrature_points);
    constexpr unsigned int n = dim * dim; // mode k along axis a is k * dim + a
    dealii::FullMatrix<double> stiffness(n);
    dealii::Vector<double> force(n), relaxed(n);
    std::array<dealii::Tensor<1, dim>, dim> modes; // their gradients, but for a factor
    Straining result;
    for (const Cell &cell : this->cells())
    {
      values.reinit(cell);
      middle.reinit(cell);
      values[dealii::FEValuesExtractors::Vector(0)].get_function_symmetric_gradients(all, strains);
      const auto [lambda, mu] = options.lame(cell->material_id());
      stiffness = 0.;
      force = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const double dx = (dim == 2 ? options.thickness : 1.) * values.JxW(q);
        const dealii::SymmetricTensor<2, dim> stress =
            2. * mu * strains[q] +
            lambda * dealii::trace(strains[q]) * dealii::unit_symmetric_tensor<dim>();
        const double energy = .5 * (stress * strains[q]) * dx;
        double largest = 0.;
        for (const double principal : dealii::eigenvalues(strains[q]))
          largest = std::max(largest, std::fabs(principal));
        result.energy += energy;
        result.large += largest > small_strain ? energy : 0.;
        if (largest > result.strain)
        {
          result.strain = largest;
          result.place = coordinates<dim>(values.quadrature_point(q));
        }
        if (!may_lock)
          continue;
        // With the Jacobian of the middle a constant stress does no work on the modes.
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int a = 0; a < dim; ++a)
            modes[k][a] = (2. * values.get_quadrature().point(q)[k] - 1.) *
                          middle.inverse_jacobian(0)[k][a] * middle.jacobian(0).determinant() /
                          values.jacobian(q).determinant();
        for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = i % dim;
          const dealii::Tensor<1, dim> &gi = modes[i / dim];
          force[i] += (stress * gi)[a] * dx;
          for (unsigned int j = 0; j < n; ++j)
          {
            const unsigned int b = j % dim;
            const dealii::Tensor<1, dim> &gj = modes[j / dim];
            stiffness(i, j) +=
                (lambda * gi[a] * gj[b] + mu * gi[b] * gj[a] + (a == b ? mu * (gi * gj) : 0.)) * dx;
          }
        }
      }
      if (!may_lock)
        continue;
      stiffness.gauss_jordan();
      stiffness.vmult(relaxed, force);
      result.locked += .5 * (relaxed * force);
    }
    return result;
  }

  template Straining ElasticSolid<2>::straining(const std::vector<double> &) const;
  template Straining ElasticSolid<3>::straining(const std::vector<double> &) const;
} // namespace taut
