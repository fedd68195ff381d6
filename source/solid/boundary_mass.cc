// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/boundary_mass.h"

#include <taut/base/exceptions.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Newton's method for D ends where the relative error of the integrals is below this.
    constexpr double converged_integrals = 1e-14;
    constexpr unsigned int most_newton_iterations = 30;

    /// Smallest entry of D: a node must keep a part of its mass.
    constexpr double smallest_factor = .1;

    /// For each DoF the number of layers of cells to the boundary, 0 on the boundary.
    template <int dim>
    std::vector<unsigned int>
    layers(const SolidMesh<dim> &mesh, const std::set<dealii::types::boundary_id> &boundaries,
           const dealii::AffineConstraints<double> &hanging, const unsigned int n_layers)
    {
      const auto &handler = mesh.dof_handler();
      const unsigned int far = n_layers + 1;
      std::vector<unsigned int> layer(handler.n_dofs(), far);
      std::vector<dealii::types::global_dof_index> dofs(handler.get_fe().n_dofs_per_face(0));
      for (const auto &cell : handler.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && boundaries.count(cell->face(f)->boundary_id()) != 0)
          {
            cell->face(f)->get_dof_indices(dofs);
            for (const auto dof : dofs)
              layer[dof] = 0;
          }
      for (const auto &line : hanging.get_lines())
        for (const auto &[parent, weight] : line.entries)
          if (layer[parent] == 0 && weight != 0.)
            layer[line.index] = 0;
      dofs.resize(handler.get_fe().n_dofs_per_cell());
      for (unsigned int l = 0; l < n_layers; ++l)
        for (const auto &cell : handler.active_cell_iterators())
        {
          cell->get_dof_indices(dofs);
          if (std::any_of(dofs.begin(), dofs.end(), [&](const auto i) { return layer[i] == l; }))
            for (const auto dof : dofs)
              layer[dof] = std::min(layer[dof], l + 1);
        }
      return layer;
    }

    /// Monomials of degrees 0 to 2 at the DoFs along x, by degree.
    template <int dim>
    class Monomials
    {
    public:
      Monomials(const SolidMesh<dim> &mesh, const std::vector<unsigned int> &layer,
                const unsigned int n_layers)
      {
        for (unsigned int i = 0; i < layer.size(); ++i)
          if (mesh.component(i) == 0)
          {
            dofs.push_back(i);
            if (layer[i] > 0 && layer[i] <= n_layers)
              receiving.push_back(i);
          }
        dealii::Point<dim> middle;
        for (const unsigned int i : receiving)
          middle += mesh.point(i) / static_cast<double>(receiving.size());
        double size = 0.;
        for (const unsigned int i : receiving)
          size = std::max(size, mesh.point(i).distance(middle));
        if (!(size > 0.))
          size = 1.;
        value.emplace_back(layer.size(), 1.);
        for (unsigned int d = 0; d < dim; ++d)
        {
          value.emplace_back(layer.size(), 0.);
          for (unsigned int i = 0; i < layer.size(); ++i)
            value.back()[i] = (mesh.point(i)[d] - middle[d]) / size;
        }
        for (unsigned int a = 1; a <= dim; ++a)
          for (unsigned int b = a; b <= dim; ++b)
          {
            value.emplace_back(layer.size(), 0.);
            for (unsigned int i = 0; i < layer.size(); ++i)
              value.back()[i] = value[a][i] * value[b][i];
          }
      }

      std::vector<unsigned int> dofs, receiving;
      std::vector<std::vector<double>> value;
    };

    /// sum of a_i M_ij b_j over the DoFs along x.
    double product(const dealii::SparseMatrix<double> &M, const std::vector<unsigned int> &dofs,
                   const std::vector<double> &a, const std::vector<double> &b)
    {
      double sum = 0.;
      for (const unsigned int i : dofs)
        if (a[i] != 0.)
          for (auto entry = M.begin(i); entry != M.end(i); ++entry)
            sum += a[i] * entry->value() * b[entry->column()];
      return sum;
    }

    std::vector<double> times(const std::vector<double> &a, const std::vector<double> &b)
    {
      std::vector<double> c(a.size());
      for (std::size_t i = 0; i < c.size(); ++i)
        c[i] = a[i] * b[i];
      return c;
    }

    /// The integrals of products of two monomials of degree up to 1, with the mass D M D: as many
    /// as there are monomials of degree 2.
    template <int dim>
    class Integrals
    {
    public:
      Integrals(const dealii::SparseMatrix<double> &M, const Monomials<dim> &p,
                const unsigned int degree)
          : M(M), p(p)
      {
        for (unsigned int a = 1; degree > 0 && a <= dim; ++a)
          pairs.push_back({0, a});
        for (unsigned int a = 1; degree > 1 && a <= dim; ++a)
          for (unsigned int b = a; b <= dim; ++b)
            pairs.push_back({a, b});
        for (const auto &[a, b] : pairs)
        {
          wanted.push_back(product(M, p.dofs, p.value[a], p.value[b]));
          scale.push_back(std::sqrt(product(M, p.dofs, p.value[a], p.value[a]) *
                                    product(M, p.dofs, p.value[b], p.value[b])));
        }
      }

      unsigned int size() const { return pairs.size(); }

      /// What the integrals lack of those with D = 1, and their derivatives with respect to the
      /// factors of the monomials that are added to D. Returns the largest relative lack.
      double linearise(const std::vector<double> &D, dealii::Vector<double> &residual,
                       dealii::FullMatrix<double> &J) const
      {
        double off = 0.;
        for (unsigned int k = 0; k < size(); ++k)
        {
          const std::vector<double> &p_a = p.value[pairs[k][0]], &p_b = p.value[pairs[k][1]];
          const std::vector<double> a = times(D, p_a), b = times(D, p_b);
          residual[k] = (wanted[k] - product(M, p.dofs, a, b)) / scale[k];
          off = std::max(off, std::fabs(residual[k]));
          for (unsigned int l = 0; l < size(); ++l)
          {
            std::vector<double> change(D.size(), 0.);
            for (const unsigned int i : p.receiving)
              change[i] = p.value[l][i];
            J(k, l) = (product(M, p.dofs, times(change, p_a), b) +
                       product(M, p.dofs, times(change, p_b), a)) /
                      scale[k];
          }
        }
        return off;
      }

    private:
      const dealii::SparseMatrix<double> &M;
      const Monomials<dim> &p;
      std::vector<std::array<unsigned int, 2>> pairs = {{0, 0}};
      std::vector<double> wanted, scale;
    };

    /// D that keeps the integrals up to a degree; empty if there is no D with positive entries.
    template <int dim>
    std::vector<double> find_factors(const dealii::SparseMatrix<double> &M, const Monomials<dim> &p,
                                     const std::vector<unsigned int> &layer,
                                     const unsigned int degree)
    {
      const Integrals<dim> integrals(M, p, degree);
      const unsigned int n = integrals.size();
      std::vector<double> D(layer.size(), 1.);
      for (std::size_t i = 0; i < D.size(); ++i)
        if (layer[i] == 0)
          D[i] = 0.;
      for (unsigned int iteration = 0; iteration < most_newton_iterations; ++iteration)
      {
        dealii::Vector<double> residual(n), step(n);
        dealii::FullMatrix<double> J(n, n);
        if (integrals.linearise(D, residual, J) <= converged_integrals)
          return D;
        try
        {
          J.gauss_jordan();
        }
        catch (const dealii::ExceptionBase &)
        {
          return {};
        }
        J.vmult(step, residual);
        double largest_step = 0.;
        for (const unsigned int i : p.receiving)
        {
          double change = 0.;
          for (unsigned int l = 0; l < n; ++l)
            change += step[l] * p.value[l][i];
          D[i] += change;
          largest_step = std::max(largest_step, std::fabs(change));
          if (!(D[i] > smallest_factor))
            return {};
        }
        // The error is rounding.
        if (iteration > 0 && largest_step <= converged_integrals)
          return D;
      }
      return {};
    }
  } // namespace

  template <int dim>
  std::vector<double> factors_without_mass(const SolidMesh<dim> &mesh,
                                           const std::set<dealii::types::boundary_id> &boundaries,
                                           const dealii::AffineConstraints<double> &hanging,
                                           const bool keeps_inertia,
                                           const dealii::SparseMatrix<double> &M)
  {
    std::vector<double> D;
    for (int degree = keeps_inertia ? 2 : 0; degree >= 0; --degree)
    {
      const unsigned int n_layers = degree == 0 ? 1 : 2 * degree;
      const std::vector<unsigned int> layer = layers(mesh, boundaries, hanging, n_layers);
      const Monomials<dim> monomials(mesh, layer, n_layers);
      D = find_factors(M, monomials, layer, degree);
      if (D.empty())
        continue;
      // All components of a node get the value of other DoFs at its place.
      const auto &handler = mesh.dof_handler();
      const dealii::FiniteElement<dim> &element = handler.get_fe();
      std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
      for (const auto &cell : handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto [component, node] = element.system_to_component_index(i);
          if (component > 0)
            D[dofs[i]] = D[dofs[element.component_to_system_index(0, node)]];
        }
      }
      return D;
    }
    throw UserError("no node beside these boundaries can take the mass of theirs; make smaller "
                    "cells");
  }

  template std::vector<double> factors_without_mass<2>(const SolidMesh<2> &,
                                                       const std::set<dealii::types::boundary_id> &,
                                                       const dealii::AffineConstraints<double> &,
                                                       bool, const dealii::SparseMatrix<double> &);
  template std::vector<double> factors_without_mass<3>(const SolidMesh<3> &,
                                                       const std::set<dealii::types::boundary_id> &,
                                                       const dealii::AffineConstraints<double> &,
                                                       bool, const dealii::SparseMatrix<double> &);
} // namespace taut
