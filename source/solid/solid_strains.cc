// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/solid/elastic_solid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace taut
{
  namespace
  {
    /// f . A^-1 f of a symmetric positive definite matrix A, given by its lower triangle.
    template <std::size_t n>
    double relaxed_by(std::array<std::array<double, n>, n> &A, std::array<double, n> &f)
    {
      double result = 0.;
      for (std::size_t j = 0; j < n; ++j)
      {
        result += f[j] * f[j] / A[j][j];
        for (std::size_t i = j + 1; i < n; ++i)
        {
          f[i] -= A[i][j] * f[j] / A[j][j];
          for (std::size_t k = j + 1; k <= i; ++k)
            A[i][k] -= A[i][j] * A[k][j] / A[j][j];
        }
      }
      return result;
    }

    template <int dim>
    dealii::SymmetricTensor<2, dim> stress(const std::pair<double, double> &lame,
                                           const dealii::SymmetricTensor<2, dim> &strain)
    {
      return 2. * lame.second * strain +
             lame.first * dealii::trace(strain) * dealii::unit_symmetric_tensor<dim>();
    }
  } // namespace

  template <int dim>
  ElasticSolid<dim>::StrainedCell::StrainedCell(const SolidMesh<dim> &mesh)
      : quadrature(mesh.quadrature(mesh.degree() + 1)),
        dofs(mesh.dof_handler().get_fe().n_dofs_per_cell()), places(dofs.size() / dim),
        displacements(dofs.size() / dim)
  {
    const dealii::FiniteElement<dim> &element = mesh.dof_handler().get_fe().base_element(0);
    const auto at = [&](const dealii::Point<dim> &point)
    {
      NodeShapes result;
      for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
      {
        result.values.push_back(element.shape_value(i, point));
        result.gradients.push_back(element.shape_grad(i, point));
      }
      return result;
    };
    for (const dealii::Point<dim> &point : quadrature.get_points())
      points.push_back(at(point));
    middle = at(mesh.quadrature(1).point(0));
  }

  template <int dim>
  void ElasticSolid<dim>::StrainedCell::reinit(const ElasticSolid<dim> &solid, const Cell &cell,
                                               const std::vector<double> &U)
  {
    const SolidMesh<dim> &mesh = *solid.mesh;
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      const auto [c, node] = mesh.dof_handler().get_fe().system_to_component_index(i);
      places[node][c] = mesh.point(dofs[i])[c];
      displacements[node][c] = solid.value_of_dof(dofs[i], U);
    }
  }

  template <int dim>
  dealii::Tensor<2, dim> ElasticSolid<dim>::StrainedCell::jacobian(const NodeShapes &at) const
  {
    dealii::Tensor<2, dim> result;
    for (std::size_t i = 0; i < places.size(); ++i)
      result += dealii::outer_product(places[i], at.gradients[i]);
    return result;
  }

  template <int dim>
  dealii::SymmetricTensor<2, dim>
  ElasticSolid<dim>::StrainedCell::strain(const NodeShapes &at,
                                          const dealii::Tensor<2, dim> &inverse) const
  {
    dealii::Tensor<2, dim> result;
    for (std::size_t i = 0; i < displacements.size(); ++i)
      result += dealii::outer_product(displacements[i], at.gradients[i]);
    return dealii::symmetrize(result * inverse);
  }

  template <int dim>
  Coordinates ElasticSolid<dim>::StrainedCell::place(const NodeShapes &at) const
  {
    dealii::Tensor<1, dim> result;
    for (std::size_t i = 0; i < places.size(); ++i)
      result += at.values[i] * places[i];
    return coordinates<dim>(result);
  }

  /**
   * The energy that lines of bilinear and trilinear cells store because they stay straight is what
   * the modes 1 - xi_k^2 would relax (R. L. Taylor, P. J. Beresford, E. L. Wilson, Int. J. Numer.
   * Meth. Engng 10 (1976)).
   */
  template <int dim>
  Straining ElasticSolid<dim>::straining(const std::vector<double> &U) const
  {
    const bool is_linear = mesh->degree() == 1, may_lock = is_linear && !mesh->is_simplicial();
    constexpr std::size_t n = dim * dim; // mode k along axis a is k * dim + a
    std::array<std::array<double, n>, n> stiffness;
    std::array<double, n> force;
    std::array<dealii::Tensor<1, dim>, dim> modes; // their gradients, but for a factor
    Straining result;
    for (const Cell &cell : this->cells())
    {
      strained.reinit(*this, cell, U);
      const dealii::Tensor<2, dim> middle = strained.jacobian(strained.middle),
                                   to_middle = dealii::invert(middle);
      const std::pair<double, double> lame = options.lame(cell->material_id());
      const auto [lambda, mu] = lame;
      stiffness = {};
      force = {};
      for (unsigned int q = 0; q < strained.points.size(); ++q)
      {
        const NodeShapes &point = strained.points[q];
        const dealii::Tensor<2, dim> jacobian = strained.jacobian(point);
        const double volume = dealii::determinant(jacobian),
                     dx = (dim == 2 ? options.thickness : 1.) * volume *
                          strained.quadrature.weight(q);
        const dealii::SymmetricTensor<2, dim> strain =
                                                  strained.strain(point, dealii::invert(jacobian)),
                                              tension = stress(lame, strain);
        const double energy = .5 * (tension * strain) * dx;
        double largest = 0.;
        for (const double principal : dealii::eigenvalues(strain))
          largest = std::max(largest, std::fabs(principal));
        result.energy += energy;
        result.large += largest > small_strain ? energy : 0.;
        if (largest > result.strain)
        {
          result.strain = largest;
          result.place = strained.place(point);
        }
        if (!may_lock)
          continue;
        // With the Jacobian of the middle a constant stress does no work on the modes.
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int a = 0; a < dim; ++a)
            modes[k][a] = (2. * strained.quadrature.point(q)[k] - 1.) * to_middle[k][a] *
                          dealii::determinant(middle) / volume;
        for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = i % dim;
          const dealii::Tensor<1, dim> &gi = modes[i / dim];
          force[i] += (tension * gi)[a] * dx;
          for (unsigned int j = 0; j <= i; ++j)
          {
            const unsigned int b = j % dim;
            const dealii::Tensor<1, dim> &gj = modes[j / dim];
            stiffness[i][j] +=
                (lambda * gi[a] * gj[b] + mu * gi[b] * gj[a] + (a == b ? mu * (gi * gj) : 0.)) * dx;
          }
        }
      }
      if (may_lock)
        result.locked += .5 * relaxed_by(stiffness, force);
    }
    if (is_linear && mesh->is_simplicial() && result.energy > 0.)
    {
      const double lacking = energy_that_simplices_lack(U);
      result.locked = lacking * result.energy / (result.energy + lacking);
    }
    return result;
  }

  /**
   * The strains of a simplex of degree 1 are constant. They differ from means at nodes by the
   * energy that they lack (O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Engng 24 (1987)).
   * Means are those of one material.
   */
  template <int dim>
  double ElasticSolid<dim>::energy_that_simplices_lack(const std::vector<double> &U) const
  {
    using Strain = dealii::SymmetricTensor<2, dim>;
    std::map<std::pair<dealii::types::global_dof_index, dealii::types::material_id>,
             std::pair<Strain, double>>
        sums; // of volume times strain and of volumes
    double result = 0.;
    for (const bool has_means : {false, true})
      for (const Cell &cell : this->cells())
      {
        strained.reinit(*this, cell, U);
        const dealii::Tensor<2, dim> jacobian = strained.jacobian(strained.middle);
        const double volume =
            (dim == 2 ? options.thickness / 2. : 1. / 6.) * dealii::determinant(jacobian);
        const Strain strain = strained.strain(strained.middle, dealii::invert(jacobian));
        const std::pair<double, double> lame = options.lame(cell->material_id());
        Strain all;
        double squares = 0.;
        for (unsigned int i = 0; i < strained.dofs.size(); i += dim)
        {
          auto &[sum, volumes] = sums[{strained.dofs[i], cell->material_id()}];
          if (!has_means)
          {
            sum += volume * strain;
            volumes += volume;
            continue;
          }
          const Strain difference = sum / volumes - strain;
          all += difference;
          squares += difference * stress(lame, difference);
        }
        // The integral of a square of linear functions over a simplex.
        result += .5 * volume / ((dim + 1) * (dim + 2)) * (squares + all * stress(lame, all));
      }
    return result;
  }

  template struct ElasticSolid<2>::StrainedCell;
  template struct ElasticSolid<3>::StrainedCell;
  template Straining ElasticSolid<2>::straining(const std::vector<double> &) const;
  template Straining ElasticSolid<3>::straining(const std::vector<double> &) const;
} // namespace taut
